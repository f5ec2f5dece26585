#pragma once

#include <google/protobuf/text_format.h>
#include <gtest/gtest.h>

#include <boost/asio.hpp>
#include <functional>

#include "client/session/view.h"
#include "daemon.h"
#include "scenes.h"

namespace metamer::test {

namespace asio = boost::asio;

inline v1::Scene parsed(const std::string& text) {
  v1::Scene scene;
  EXPECT_TRUE(google::protobuf::TextFormat::ParseFromString(text, &scene));
  return scene;
}

/// The small scene without mirrors, which both backends draw alike.
inline v1::Scene direct_scene() {
  v1::Scene scene = parsed(small_scene());
  scene.mutable_settings()->set_depth(0);
  return scene;
}

/// A client that opens views and waits for everything.
class Viewer {
 public:
  explicit Viewer(const Daemon& daemon) {
    run([&]() -> asio::awaitable<void> {
      auto connected = co_await client::Session::connect(daemon.address());
      EXPECT_TRUE(connected);
      session_ = std::move(*connected);
    });
  }
  ~Viewer() {
    session_.reset();
    loop_.run();
  }

  /// Null and the error where it can't be.
  std::unique_ptr<client::View> open(const v1::Scene& scene, v1::Backend backend = v1::CPU,
                                     const std::vector<client::Upload>& files = {}) {
    std::unique_ptr<client::View> view;
    run([&] { return open_into(scene, files, backend, view); });
    return view;
  }
  /// With a mesh, while this client goes on; how it came out is in error().
  void begin_open(const v1::Scene& scene, const client::Upload& mesh, v1::Backend backend,
                  std::unique_ptr<client::View>& view, bool& ended) {
    loop_.restart();
    asio::co_spawn(loop_, open_into(scene, {mesh}, backend, view),
                   [&](std::exception_ptr) { ended = true; });
  }
  void update(client::View& view, v1::UpdateView change,
              const std::vector<client::Upload>& files = {}) {
    run([&]() -> asio::awaitable<void> {
      EXPECT_TRUE(co_await view.update(std::move(change), files));
    });
  }
  void replace(client::View& view, const v1::Scene& scene, std::uint64_t revision,
               const std::vector<client::Upload>& files = {}) {
    run([&]() -> asio::awaitable<void> {
      const client::Submission submission = submission_of(scene, files);
      EXPECT_TRUE(co_await view.replace(submission, revision));
    });
  }
  void ask(client::View& view, bool xyz = false) {
    run([&]() -> asio::awaitable<void> { co_await view.ask(xyz); });
  }
  client::Answer<v1::Probed> probe(client::View& view, std::uint32_t x, std::uint32_t y,
                                   std::uint32_t side = 1) {
    client::Answer<v1::Probed> answer;
    run([&]() -> asio::awaitable<void> { answer = co_await view.probe(x, y, side); });
    return answer;
  }
  void close(client::View& view) {
    run([&]() -> asio::awaitable<void> { EXPECT_TRUE(co_await view.close()); });
  }
  /// A frame that was asked for; nothing and the error where there is none.
  std::optional<client::View::Picture> next(client::View& view) {
    std::optional<client::View::Picture> picture;
    run([&]() -> asio::awaitable<void> {
      auto next = co_await view.next();
      error_ = next ? client::SessionError{} : next.error();
      if (next) picture = std::move(*next);
    });
    return picture;
  }
  /// The frame that has all samples of a revision.
  client::View::Picture complete(client::View& view, std::uint64_t revision) {
    for (int i = 0; i < 100; ++i) {
      ask(view);
      auto picture = next(view);
      if (!picture) break;
      if (picture->frame.complete() && picture->frame.revision() == revision) return *picture;
    }
    ADD_FAILURE() << "never complete: " << error_.message;
    return {};
  }
  const client::SessionError& error() const { return error_; }

 private:
  static client::Submission submission_of(const v1::Scene& scene,
                                          std::vector<client::Upload> files) {
    client::Submission submission = client::make_submission(scene, {}, "view", false);
    for (client::Upload& file : files) {
      v1::AssetName& asset = *submission.request.add_asset();
      asset.set_name(file.name);
      asset.set_sha256(std::string(to_bytes(file.sha256)));
      submission.uploads.push_back(std::move(file));
    }
    return submission;
  }

  asio::awaitable<void> open_into(v1::Scene scene, std::vector<client::Upload> files,
                                  v1::Backend backend, std::unique_ptr<client::View>& view) {
    client::Submission submission = submission_of(scene, std::move(files));
    submission.request.set_backend(backend);
    auto opened = co_await client::View::open(*session_, submission);
    error_ = opened ? client::SessionError{} : opened.error();
    if (opened) view = std::move(*opened);
  }

  void run(const std::function<asio::awaitable<void>()>& work) {
    loop_.restart();
    bool done = false;
    asio::co_spawn(loop_, work(), [&](std::exception_ptr) { done = true; });
    while (!done && loop_.run_one() > 0) {
    }
  }

  asio::io_context loop_{1};
  std::unique_ptr<client::Session> session_;
  client::SessionError error_;
};

}  // namespace metamer::test
