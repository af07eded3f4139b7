#include "core/clone/pixel_planes.h"

#include "core/clone/read_ahead.h"

#include <bit>
#include <cstdint>
#include <cstring>

namespace oversketch {
namespace {

using Floats = Float4::Lanes;
using Ints [[gnu::vector_size(16)]] = std::int32_t;

static_assert(std::endian::native == std::endian::little, "the first of packed numbers is the lowest");
static_assert(sizeof(Rgba) == sizeof(Floats) && sizeof(Rgba8) == 4 && sizeof(LivePixel) == 8);

template <class Vector>
Vector load(const void* from) {
  Vector v;
  std::memcpy(&v, from, sizeof v);
  return v;
}

void store(float* to, const Floats& v) {
  std::memcpy(to, &v, sizeof v);
}

Floats to_floats(const Ints& v) {
  return __builtin_convertvector(v, Floats);
}

/// Rows of four become columns.
struct Four {
  Floats a, b, c, d;

  Four turned() const {
    const Floats ab_low = __builtin_shufflevector(a, b, 0, 4, 1, 5),
                 ab_high = __builtin_shufflevector(a, b, 2, 6, 3, 7);
    const Floats cd_low = __builtin_shufflevector(c, d, 0, 4, 1, 5),
                 cd_high = __builtin_shufflevector(c, d, 2, 6, 3, 7);
    return {__builtin_shufflevector(ab_low, cd_low, 0, 1, 4, 5), __builtin_shufflevector(ab_low, cd_low, 2, 3, 6, 7),
            __builtin_shufflevector(ab_high, cd_high, 0, 1, 4, 5),
            __builtin_shufflevector(ab_high, cd_high, 2, 3, 6, 7)};
  }
};

constexpr std::size_t kSlot = 3;

/// The fourth number goes where the next slot's first one will be written.
void store_over(float* slot, const Floats& v) {
  store(slot, v);
}

void store_slot(float* slot, const Floats& v) {
  std::memcpy(slot, &v, kSlot * sizeof(float));
}

/// Four slots of which the last has a successor that is yet to be written.
void store_slots(float* slots, const Four& pixels) {
  store_over(slots, pixels.a);
  store_over(slots + kSlot, pixels.b);
  store_over(slots + 2 * kSlot, pixels.c);
  store_over(slots + 3 * kSlot, pixels.d);
}

/// Of every second pixel from `planes` on, `count` of them.
void to_half(const float* planes, std::size_t stride, std::size_t count, float* slots) {
  std::size_t i = 0;
  const auto every_second = [](const float* from) {
    return __builtin_shufflevector(load<Floats>(from), load<Floats>(from + 4), 0, 2, 4, 6);
  };
  for (; i + 4 < count; i += 4, planes += 8, slots += 4 * kSlot)
    store_slots(slots,
                Four{every_second(planes), every_second(planes + stride), every_second(planes + 2 * stride), Floats{}}
                    .turned());
  for (; i < count; ++i, planes += 2, slots += kSlot)
    store_slot(slots, Floats{planes[0], planes[stride], planes[2 * stride], 0});
}

void to_half(const Float4* from, std::size_t count, float* slots) {
  std::size_t i = 0;
  for (; i + 1 < count; ++i, from += 2, slots += kSlot)
    store_over(slots, from->v);
  if (i < count) store_slot(slots, from->v);
}

} // namespace

bool to_planes(const Rgba* from, std::size_t count, float* planes, std::size_t stride) {
  std::size_t i = 0;
  Ints opaque = {-1, -1, -1, -1};
  float *red = planes, *green = planes + stride, *blue = planes + 2 * stride;
  for (; i + 4 <= count; i += 4) {
    const auto pixel = [&](std::size_t k) { return load<Floats>(from + i + k); };
    const Four channels = Four{pixel(0), pixel(1), pixel(2), pixel(3)}.turned();
    store(red + i, channels.a);
    store(green + i, channels.b);
    store(blue + i, channels.c);
    opaque &= channels.d == 1.0F;
  }
  bool rest = true;
  for (; i < count; ++i) {
    red[i] = from[i].r, green[i] = from[i].g, blue[i] = from[i].b;
    rest &= from[i].a == 1.0F;
  }
  return rest && (opaque[0] & opaque[1] & opaque[2] & opaque[3]) != 0;
}

bool to_planes(const Rgba8* from, std::size_t count, float* planes, std::size_t stride) {
  constexpr float kLevel = 1 / 255.0F;
  std::size_t i = 0;
  float *red = planes, *green = planes + stride, *blue = planes + 2 * stride;
  Ints all = {-1, -1, -1, -1};
  for (; i + 4 <= count; i += 4) {
    read_ahead(from + i);
    const Ints pixels = load<Ints>(from + i);
    all &= pixels;
    store(red + i, kLevel * to_floats(pixels & 255));
    store(green + i, kLevel * to_floats((pixels >> 8) & 255));
    store(blue + i, kLevel * to_floats((pixels >> 16) & 255));
  }
  std::uint8_t rest = 255;
  for (; i < count; ++i) {
    red[i] = kLevel * from[i].r, green[i] = kLevel * from[i].g, blue[i] = kLevel * from[i].b;
    rest &= from[i].a;
  }
  const Ints alpha = (all >> 24) & 255;
  return (rest & alpha[0] & alpha[1] & alpha[2] & alpha[3]) == 255;
}

void to_planes(const LivePixel* from, std::size_t count, float* planes, std::size_t stride) {
  constexpr float kUnit = 1 / LivePixel::kOpaque;
  constexpr int kHalf = 32;
  std::size_t i = 0;
  float *red = planes, *green = planes + stride, *blue = planes + 2 * stride;
  for (; i + 4 <= count; i += 4) {
    read_ahead(from + i);
    const Ints two = load<Ints>(from + i), next = load<Ints>(from + i + 2);
    const Ints red_green = __builtin_shufflevector(two, next, 0, 2, 4, 6);
    const Ints blue_alpha = __builtin_shufflevector(two, next, 1, 3, 5, 7);
    store(red + i, kUnit * to_floats(((red_green << 16) >> 16) - kHalf));
    store(green + i, kUnit * to_floats((red_green >> 16) - kHalf));
    store(blue + i, kUnit * to_floats(((blue_alpha << 16) >> 16) - kHalf));
  }
  const auto value = [](std::int16_t v) { return kUnit * static_cast<float>(v - kHalf); };
  for (; i < count; ++i)
    red[i] = value(from[i].r), green[i] = value(from[i].g), blue[i] = value(from[i].b);
}

void to_slots(const float* planes, std::size_t stride, std::size_t count, GridSlots<float> slots) {
  to_half(planes, stride, (count + 1) / 2, slots.even);
  to_half(planes + 1, stride, count / 2, slots.odd);
}

void to_slots(std::span<const Float4> from, GridSlots<float> slots) {
  if (from.empty()) return;
  to_half(from.data(), (from.size() + 1) / 2, slots.even);
  to_half(from.data() + 1, from.size() / 2, slots.odd);
}

void from_slots(GridSlots<const float> slots, std::span<Float4> to) {
  const Ints kColours = {-1, -1, -1, 0};
  const auto pixel = [&](const float* slot) { return Float4{(Floats)((Ints)load<Floats>(slot) & kColours)}; };
  std::size_t i = 0;
  for (; i + 1 < to.size(); i += 2, slots = slots.from(2)) {
    read_ahead(slots.even);
    read_ahead(slots.odd);
    to[i] = pixel(slots.even);
    to[i + 1] = pixel(slots.odd);
  }
  if (i < to.size()) to[i] = pixel(slots.even);
}

} // namespace oversketch
