#include "daemon.h"

#include <fcntl.h>
#include <spdlog/spdlog.h>
#include <sys/stat.h>
#include <unistd.h>

#include <fstream>
#include <stdexcept>

namespace metamer::service::test {

Daemon::Daemon(const std::function<void(ServiceOptions&)>& change)
    : folder_(TemporaryFolder::make().value()) {
  spdlog::set_level(spdlog::level::off);
  const std::string gate = (folder() / "gate").string();
  ::mkfifo(gate.c_str(), 0600);
  gate_ = ::open(gate.c_str(), O_RDWR | O_CLOEXEC);

  ServiceOptions options;
  options.listen = {wire::parse_endpoint("unix:" + socket()).value(),
                    wire::parse_endpoint("127.0.0.1:0").value()};
  options.open = true;
  options.store = folder() / "store";
  options.first_job_id = 1;
  options.worker.command.program = METAMER_BIN "/metamer-fake-worker";
  if (change) change(options);
  if (!options.state.empty()) {
    // The worker looks for its gate beside the assets.
    std::filesystem::remove(options.state / "gate");
    std::filesystem::create_symlink(gate, options.state / "gate");
  }
  service_ = std::make_unique<Service>(context_, options);
  if (auto started = service_->start(); !started) {
    throw std::runtime_error(started.error().message);
  }
  port_ = service_->endpoints().back().port;
  thread_ = std::thread([this] { context_.run(); });
}

Daemon::~Daemon() {
  boost::asio::post(context_, [this] { service_->stop(); });
  thread_.join();
  ::close(gate_);
}

void Daemon::open_gate() {
  if (::write(gate_, "x", 1) != 1) throw std::runtime_error("the gate is stuck");
}

void Daemon::spoil_start(const std::string& how) { std::ofstream(folder() / how).put('x'); }
void Daemon::mend_start(const std::string& how) { std::filesystem::remove(folder() / how); }

}  // namespace metamer::service::test
