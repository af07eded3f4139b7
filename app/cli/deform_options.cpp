#include "app/cli/deform_options.h"

#include <map>

namespace oversketch::cli {

void add_deform_options(CLI::App* sub, DeformOptions& options) {
  const std::map<std::string, Method> methods = {{"paper", Method::kPaper}, {"initial", Method::kInitial}};
  sub->add_option("--method", options.method, "paper (default) or initial")
      ->transform(CLI::CheckedTransformer(methods))
      ->type_name("METHOD");
  sub->add_option("--cell", options.cell_px, "side of a mesh cell, source pixels")
      ->type_name("PX")
      ->capture_default_str();
  sub->add_option("--handle-weight", options.handle_weight, "the paper's ω, 0.01 to 100")
      ->type_name("ω")
      ->capture_default_str();
  sub->add_option("--iterations", options.iterations, "gradient steps of the paper's method")
      ->type_name("N")
      ->capture_default_str();
}

} // namespace oversketch::cli
