// metamerd_man FOLDER: writes the daemon's man pages there.
#include <fstream>

#include "server/service/ops/man_page.h"

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  const std::string folder = argv[1];
  std::ofstream program(folder + "/metamerd.8"), file(folder + "/metamerd.toml.5");
  program << metamer::service::metamerd_man_page();
  file << metamer::service::config_man_page();
  return program.flush() && file.flush() ? 0 : 1;
}
