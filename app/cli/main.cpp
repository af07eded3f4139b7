#include "app/cli/cli.h"

int main(int argc, char** argv) {
  return oversketch::cli::Cli().run(argc, argv);
}
