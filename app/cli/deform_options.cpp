#include "app/cli/deform_options.h"

namespace oversketch::cli {

void add_deform_options(CLI::App* sub, DeformOptions& options) {
  const auto set_method = [&options](const std::string& name) {
    options.method = name == "flipfree" ? Method::kFlipfree : name == "paper" ? Method::kPaper : Method::kInitial;
  };
  sub->add_option_function<std::string>("--method", set_method, "flipfree (default), paper or initial")
      ->check(CLI::IsMember({"flipfree", "paper", "initial"}))
      ->type_name("METHOD");
  sub->add_option("--cell", options.cell_px, "side of a mesh cell, source pixels")
      ->type_name("PX")
      ->capture_default_str();
  sub->add_option("--stiffness", options.stiffness, "against change of area, flipfree; 0.001 to 1000")
      ->type_name("λ")
      ->capture_default_str();
  sub->add_option("--follow", options.follow, "how closely the sketch is followed, flipfree; 0.01 to 10000")
      ->type_name("W")
      ->capture_default_str();
  sub->add_option("--handle-weight", options.handle_weight, "the paper's ω, 0.01 to 100")
      ->type_name("ω")
      ->capture_default_str();
  sub->add_option("--iterations", options.iterations, "gradient steps of the paper's method")
      ->type_name("N")
      ->capture_default_str();
}

} // namespace oversketch::cli
