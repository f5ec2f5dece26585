#include "server/service/service.h"

namespace metamer::service {

namespace {

ServiceOptions completed(ServiceOptions options) {
  std::error_code ignored;
  const auto absolute = std::filesystem::absolute(options.store, ignored);
  if (!ignored) options.store = absolute;
  options.worker.command.store = options.store;
  return options;
}

Supervisor::Options for_backend(Supervisor::Options options, v1::Backend backend) {
  options.command.backend = backend;
  return options;
}

}  // namespace

Service::Service(asio::io_context& context, ServiceOptions options)
    : context_(context),
      options_(completed(std::move(options))),
      queue_(options_.keep_bytes, options_.first_job_id),
      cpu_(context.get_executor(), for_backend(options_.worker, v1::CPU), queue_, views_),
      gl_(context.get_executor(), for_backend(options_.worker, v1::GL), queue_, views_),
      listener_(context.get_executor()) {}

Result<void> Service::start() {
  auto store = AssetStore::open(options_.store, options_.store_bytes);
  if (!store) return tl::unexpected(store.error());
  store_ = *std::move(store);
  service_context_ = std::make_unique<ServiceContext>(
      ServiceContext{*store_, queue_, views_, cpu_, gl_, [this] { return listener_.sessions(); },
                     options_.patience});
  for (const wire::Endpoint& endpoint : options_.listen) {
    if (auto opened = listener_.open(endpoint); !opened) return opened;
  }
  cpu_.start();
  listener_.start(*service_context_);
  return {};
}

void Service::stop() {
  listener_.stop();
  cpu_.stop();
  gl_.stop();
}

}  // namespace metamer::service
