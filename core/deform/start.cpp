#include "core/deform/start.h"

#include <algorithm>
#include <array>
#include <complex>
#include <numbers>
#include <vector>

namespace oversketch {
namespace {

using Complex = std::complex<double>;

/// Frequencies kept: enough to tell ordinary outlines apart, few enough that hand noise does not decide.
constexpr int kFrequencies = 32;
/// |C|² is a trigonometric polynomial of degree 2·32: eight samples to its shortest wave.
constexpr int kSamples = 512;
/// How much worse another maximum may fit and still count as equally good: a part of the best residual (hand noise
/// makes residuals of symmetric shapes differ that much), and of the curve's spread where there is hardly a residual.
constexpr double kTieOfResidual = 0.25;
constexpr double kTieOfSpread = 2e-4;

/// Coefficients k = ±1…±32 of the curve as a function of the fraction of its length; positive[k − 1], negative[k − 1].
struct Spectrum {
  std::array<Complex, kFrequencies> positive{};
  std::array<Complex, kFrequencies> negative{};

  double power() const {
    double sum = 0;
    for (int k = 0; k < kFrequencies; ++k)
      sum += std::norm(positive[k]) + std::norm(negative[k]);
    return sum;
  }
};

/// Exact for the polygon: integrating by parts leaves  B_k = L/(2πk)² Σ_segments τ (E^k(end) − E^k(start)),
/// τ the segment's unit tangent and E = e^{−2πis/L}.
Spectrum transform(const ClosedCurve& curve) {
  Spectrum out;
  const Points& points = curve.points();
  const int count = curve.size();
  const double turn = -2 * std::numbers::pi / curve.length();
  Complex from = 1.0; // E at s = 0
  for (int i = 0; i < count; ++i) {
    const Point a = points[i], b = points[(i + 1) % count];
    const double size = distance(a, b);
    const Complex to = i + 1 < count ? std::polar(1.0, turn * curve.s_at(i + 1)) : Complex(1.0);
    if (size > 0) {
      const Complex tangent = to_complex(b - a) / size;
      Complex from_k = from, to_k = to;
      for (int k = 0; k < kFrequencies; ++k) {
        const Complex step = to_k - from_k;
        out.positive[k] += tangent * step;
        out.negative[k] += tangent * std::conj(step);
        from_k *= from;
        to_k *= to;
      }
    }
    from = to;
  }
  for (int k = 0; k < kFrequencies; ++k) {
    const double frequency = 2 * std::numbers::pi * (k + 1);
    const double weight = curve.length() / (frequency * frequency);
    out.positive[k] *= weight;
    out.negative[k] *= weight;
  }
  return out;
}

/// C(t) and its derivative.
struct Correlation {
  Spectrum product;

  Complex at(double t, Complex* slope = nullptr) const {
    const Complex step = std::polar(1.0, 2 * std::numbers::pi * t);
    Complex wave = 1.0, sum = 0.0, derivative = 0.0;
    for (int k = 0; k < kFrequencies; ++k) {
      wave *= step;
      const Complex plus = product.positive[k] * wave, minus = product.negative[k] * std::conj(wave);
      sum += plus + minus;
      derivative += static_cast<double>(k + 1) * (plus - minus);
    }
    if (slope) *slope = Complex(0, 2 * std::numbers::pi) * derivative;
    return sum;
  }

  /// Half the derivative of |C|².
  double rise(double t) const {
    Complex slope;
    const Complex value = at(t, &slope);
    return (std::conj(value) * slope).real();
  }
};

/// The zero of the rise between `low` (rising) and `high` (falling): 2/512 halved 48 times is below rounding.
double find_peak(const Correlation& correlation, double low, double high) {
  for (int halving = 0; halving < 48; ++halving) {
    const double middle = 0.5 * (low + high);
    (correlation.rise(middle) > 0 ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

/// How far below the greatest |C|² another one may lie.
double tie(double best, double most) {
  return kTieOfResidual * (most - best) + kTieOfSpread * most;
}

struct Peak {
  double t = 0;
  double height = 0; // |C|²
  double turn = 0;   // |arg C|
};

/// The maxima of |C|² that may come within the tie of the greatest; `most` is what a perfect fit would reach.
std::vector<Peak> find_peaks(const Correlation& correlation, double most) {
  std::array<double, kSamples> heights{};
  for (int i = 0; i < kSamples; ++i)
    heights[i] = std::norm(correlation.at(static_cast<double>(i) / kSamples));
  const double best = *std::max_element(heights.begin(), heights.end());
  std::vector<Peak> peaks;
  for (int i = 0; i < kSamples; ++i) {
    // A peak between samples is a little higher than both: only clearly lower ones are skipped here.
    if (heights[i] < best - 2 * tie(best, most)) continue;
    if (heights[i] < heights[(i + kSamples - 1) % kSamples] || heights[i] < heights[(i + 1) % kSamples]) continue;
    const double low = (i - 1.0) / kSamples, high = (i + 1.0) / kSamples;
    const bool bracketed = correlation.rise(low) > 0 && correlation.rise(high) < 0;
    const double t = bracketed ? find_peak(correlation, low, high) : static_cast<double>(i) / kSamples;
    const Complex value = correlation.at(t);
    peaks.push_back({t, std::norm(value), std::abs(std::arg(value))});
  }
  return peaks;
}

} // namespace

double choose_start(const ClosedCurve& outline, const ClosedCurve& sketch) {
  const Spectrum from = transform(outline);
  Spectrum to = transform(sketch);
  const bool reversed = (outline.signed_area() > 0) != (sketch.signed_area() > 0);
  if (reversed) std::swap(to.positive, to.negative);

  Correlation correlation;
  for (int k = 0; k < kFrequencies; ++k) {
    correlation.product.positive[k] = std::conj(from.positive[k]) * to.positive[k];
    correlation.product.negative[k] = std::conj(from.negative[k]) * to.negative[k];
  }
  const double most = from.power() * to.power();
  const std::vector<Peak> peaks = find_peaks(correlation, most);
  double best = 0;
  for (const Peak& peak : peaks)
    best = std::max(best, peak.height);
  const Peak* chosen = nullptr;
  for (const Peak& peak : peaks) {
    if (peak.height >= best - tie(best, most) && (!chosen || peak.turn < chosen->turn)) chosen = &peak;
  }
  CHECK(chosen, "a continuous periodic function has a greatest value");
  return sketch.wrap((reversed ? -chosen->t : chosen->t) * sketch.length());
}

} // namespace oversketch
