// A view's answers, in whatever order a server sends them, and those of servers that lie or are
// older.
#include "client/session/view.h"

#include <gtest/gtest.h>

#include <boost/asio/experimental/awaitable_operators.hpp>

#include "fake_server.h"

namespace metamer::test {
namespace {

namespace asio = boost::asio;
using namespace asio::experimental::awaitable_operators;
using Kind = SessionError::Kind;
using Envelopes = std::vector<v1::Envelope>;

/// A server with one view, of 4 by 2 pixels.
class SessionView : public testing::Test {
 protected:
  /// What it says to requests of the view but OpenView and CloseView.
  std::function<Envelopes(const v1::Envelope&)> answer_ = [](const v1::Envelope&) {
    return Envelopes{};
  };

  /// Opens the view, and does `work` with it.
  void run(const std::function<asio::awaitable<void>(View&)>& work) {
    FakeServer server([this](const v1::Envelope& request) { return answer_to(request); });
    bool done = false;
    EXPECT_FALSE(server.run([&](Session& session) -> asio::awaitable<void> {
      auto view = co_await View::open(session, {});
      if (!view) co_return;
      co_await work(**view);
      done = true;
    }));
    EXPECT_TRUE(done);
  }

  v1::Envelope event() const {
    v1::Envelope envelope;
    envelope.set_request_id(view_request_);
    envelope.mutable_view_event()->set_view_id(5);
    return envelope;
  }
  v1::Envelope row(std::uint32_t y, std::size_t xyz_bytes = 0) const {
    v1::Envelope envelope = event();
    v1::FrameBand& band = *envelope.mutable_view_event()->mutable_band();
    band.set_width(4);
    band.set_height(2);
    band.set_first_row(y);
    band.set_rgb(std::string(12, static_cast<char>(y)));
    band.set_xyz(std::string(xyz_bytes, '\0'));
    if (y == 1) band.mutable_frame()->set_complete(true);
    return envelope;
  }
  v1::Envelope probed(std::uint64_t number, int values = 471) const {
    v1::Envelope envelope = event();
    v1::Probed& to = *envelope.mutable_view_event()->mutable_probed();
    to.set_number(number);
    to.set_object("ball");
    to.set_material("paint");
    to.mutable_place();
    to.mutable_normal();
    for (int i = 0; i < values; ++i) {
      to.add_eye(1);
      to.add_light(2);
      to.add_surface(0.5);
    }
    return envelope;
  }

 private:
  Envelopes answer_to(const v1::Envelope& request) {
    if (request.has_hello()) return {welcome()};
    if (request.has_offer_assets()) {
      v1::Envelope none;
      none.mutable_missing_assets();
      return {none};
    }
    if (!request.has_open_view()) return answer_(request);
    view_request_ = request.request_id();
    v1::Envelope opened = event();
    opened.mutable_view_event()->mutable_updated()->mutable_plan()->set_width(4);
    opened.mutable_view_event()->mutable_updated()->mutable_timing()->set_compile(0.5);
    return {opened};
  }

  std::uint64_t view_request_ = 0;
};

TEST_F(SessionView, KnowsItsPlanAndWhatItTook) {
  run([](View& view) -> asio::awaitable<void> {
    EXPECT_EQ(view.plan().width(), 4u);
    EXPECT_EQ(view.updated().timing().compile(), 0.5);
    co_return;
  });
}

TEST_F(SessionView, AProbesAnswerMayComeBetweenTheBandsOfAFrame) {
  answer_ = [this](const v1::Envelope& request) -> Envelopes {
    if (request.has_next_frame()) return {row(0)};
    return {probed(request.probe().number()), row(1)};
  };
  run([](View& view) -> asio::awaitable<void> {
    co_await view.ask();
    // Whoever of the two reads, each gets its own.
    auto [picture, probed] = co_await (view.next() && view.probe(1, 1));
    if (!probed || !picture) co_return ADD_FAILURE(), void();
    EXPECT_EQ(probed->light(470), 2);
    EXPECT_EQ(picture->rgb.size(), 24u);
  });
}

TEST_F(SessionView, AFrameWaitsWhileAProbeIsReadFor) {
  answer_ = [this](const v1::Envelope& request) -> Envelopes {
    if (request.has_next_frame()) return {row(0), row(1)};
    return {probed(request.probe().number())};
  };
  run([](View& view) -> asio::awaitable<void> {
    co_await view.ask();
    EXPECT_TRUE(co_await view.probe(1, 1));
    const auto picture = co_await view.next();
    EXPECT_TRUE(picture && picture->frame.complete());
  });
}

TEST_F(SessionView, AnOlderServerKnowsNoProbesAndTheViewLivesOn) {
  answer_ = [this](const v1::Envelope& request) -> Envelopes {
    if (request.has_next_frame()) return {row(0), row(1)};
    return {error(v1::Error::UNKNOWN_MESSAGE, "this server does not know that message")};
  };
  run([](View& view) -> asio::awaitable<void> {
    const auto probed = co_await view.probe(1, 1);
    EXPECT_FALSE(probed);
    if (!probed) {
      EXPECT_EQ(probed.error().code, v1::Error::UNKNOWN_MESSAGE);
    }
    co_await view.ask(true);
    const auto picture = co_await view.next();
    EXPECT_TRUE(picture && picture->xyz.empty()) << "nor does it know X Y Z";
  });
}

TEST_F(SessionView, AProbeThatNewerOnesReplacedIsToldSo) {
  answer_ = [this](const v1::Envelope& request) -> Envelopes {
    static int asked;
    if (++asked == 1) return {};
    return {probed(request.probe().number())};
  };
  run([](View& view) -> asio::awaitable<void> {
    auto [older, newer] = co_await (view.probe(0, 0) && view.probe(1, 1));
    EXPECT_TRUE(newer);
    EXPECT_FALSE(older);
    if (!older) {
      EXPECT_EQ(older.error().message, "newer probes took the turn of this one");
    }
  });
}

TEST_F(SessionView, AServerThatLiesOfAPlaceIsLeft) {
  for (const int values : {0, 470, 472}) {
    answer_ = [&, values](const v1::Envelope& request) -> Envelopes {
      return {probed(request.probe().number(), values)};
    };
    run([](View& view) -> asio::awaitable<void> {
      const auto probed = co_await view.probe(1, 1);
      EXPECT_TRUE(!probed && probed.error().kind == Kind::disconnected);
      const auto picture = co_await view.next();
      EXPECT_TRUE(!picture && picture.error().kind == Kind::disconnected);
    });
  }
}

TEST_F(SessionView, XyzFitTheFrame) {
  const auto is_taken = [&](std::size_t first, std::size_t last) {
    answer_ = [&, first, last](const v1::Envelope&) -> Envelopes {
      return {row(0, first), row(1, last)};
    };
    bool taken = false;
    run([&](View& view) -> asio::awaitable<void> {
      co_await view.ask(true);
      const auto picture = co_await view.next();
      taken = picture && picture->xyz.size() == (first + last) / 4;
    });
    return taken;
  };
  EXPECT_TRUE(is_taken(48, 48));
  EXPECT_TRUE(is_taken(0, 0));
  EXPECT_FALSE(is_taken(48, 0));
  EXPECT_FALSE(is_taken(0, 48));
  EXPECT_FALSE(is_taken(48, 47));
  EXPECT_FALSE(is_taken(48, 52));
}

TEST_F(SessionView, AFrameThatNobodyAskedForIsALie) {
  answer_ = [this](const v1::Envelope&) -> Envelopes { return {row(0), row(1)}; };
  run([](View& view) -> asio::awaitable<void> {
    const auto probed = co_await view.probe(1, 1);
    EXPECT_TRUE(!probed && probed.error().kind == Kind::disconnected);
  });
}

TEST_F(SessionView, WhenItIsClosedEverybodyHearsWhy) {
  answer_ = [this](const v1::Envelope& request) -> Envelopes {
    if (request.has_next_frame()) return {};
    v1::Envelope closed = event();
    closed.mutable_view_event()->mutable_closed()->mutable_reason()->set_reason("the worker died");
    return {closed};
  };
  run([](View& view) -> asio::awaitable<void> {
    co_await view.ask();
    auto [picture, probed] = co_await (view.next() && view.probe(1, 1));
    EXPECT_TRUE(!probed && probed.error().message == "the worker died");
    EXPECT_TRUE(!picture && picture.error().message == "the worker died");
  });
}

}  // namespace
}  // namespace metamer::test
