#include "server/worker/out_of_memory.h"

#include <cstdlib>
#include <exception>
#include <new>

#include "common/wire/worker_exit.h"

namespace metamer::worker {
namespace {

[[noreturn]] void end() { std::_Exit(wire::exit_out_of_memory); }

/// What libraries throw by themselves, and what mesh arrays do whose memory can't be mapped.
[[noreturn]] void end_for_what_was_thrown() {
  try {
    if (const auto thrown = std::current_exception()) std::rethrow_exception(thrown);
  } catch (const std::bad_alloc&) {
    end();
  } catch (...) {
    std::abort();
  }
  std::abort();
}

}  // namespace

void end_when_out_of_memory() {
  std::set_new_handler(end);
  std::set_terminate(end_for_what_was_thrown);
}

}  // namespace metamer::worker
