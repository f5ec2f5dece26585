// metamer_man FILE: writes the man page of metamer there.
#include <fstream>

#include "client/cli/man_page.h"

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  std::ofstream file(argv[1]);
  file << metamer::cli::man_page();
  return file.flush() ? 0 : 1;
}
