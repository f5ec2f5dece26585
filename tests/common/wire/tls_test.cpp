// Connections by TLS: who is trusted, and what becomes of those who speak something else.

#include "common/wire/tls.h"

#include <gtest/gtest.h>

#include "certificates.h"
#include "common/wire/channel.h"
#include "metamer/v1/envelope.pb.h"

namespace metamer::wire {

namespace {

/// What became of one connection, at each end.
struct Meeting {
  std::optional<TlsError> server, client;
  std::optional<PeerCertificate> server_sees, client_sees;
  std::string heard;  // by the server
};

class Tls : public testing::Test {
 protected:
  test::Certificates certificates_;
  TlsIdentity server_ = certificates_.sign("server", "DNS:localhost,IP:127.0.0.1");
  asio::io_context loop_;

  TlsContext server(const std::filesystem::path& client_authorities = {}) {
    return TlsContext::server(server_, client_authorities).value();
  }
  TlsContext client(TlsTrust trust, TlsIdentity identity = {}) {
    return TlsContext::client(trust, identity).value();
  }

  Meeting meet(TlsContext server, TlsContext client, const std::string& host = "localhost",
               const std::string& words = "x") {
    Meeting meeting;
    auto acceptor = Acceptor::listen(loop_.get_executor(), parse_endpoint("0").value()).value();
    const auto serve = [&]() -> asio::awaitable<void> {
      auto [error, socket] = co_await acceptor.accept();
      auto stream = co_await accept_tls(std::move(socket), server);
      if (!stream) {
        meeting.server = stream.error();
        co_return;
      }
      if ((*stream)->certificate()) meeting.server_sees = *(*stream)->certificate();
      std::array<char, 1000> piece;
      while (true) {
        auto [end, size] = (*stream)->read(piece.data(), piece.size());
        meeting.heard.append(piece.data(), size);
        if (end == asio::error::would_block) end = co_await (*stream)->wait_to_read();
        if (end) co_return;
      }
    };
    const auto ask = [&]() -> asio::awaitable<void> {
      auto socket = co_await connect(acceptor.endpoint());
      auto stream = co_await connect_tls(std::move(*socket), client, host);
      if (!stream) {
        meeting.client = stream.error();
        co_return;
      }
      meeting.client_sees = *(*stream)->certificate();
      for (std::size_t sent = 0; sent < words.size();) {
        auto [error, size] = (*stream)->write(words.data() + sent, words.size() - sent);
        sent += size;
        if (error == asio::error::would_block) error = co_await (*stream)->wait_to_write();
        if (error) break;
      }
      (*stream)->close();
    };
    asio::co_spawn(loop_, serve(), asio::detached);
    asio::co_spawn(loop_, ask(), asio::detached);
    loop_.run();
    loop_.restart();
    return meeting;
  }

  /// What a server answers to these bytes, and what it says of them.
  std::pair<TlsError, std::string> say_plainly(const std::string& bytes) {
    std::pair<TlsError, std::string> result;
    auto acceptor = Acceptor::listen(loop_.get_executor(), parse_endpoint("0").value()).value();
    const auto context = server();
    const auto serve = [&]() -> asio::awaitable<void> {
      auto [error, socket] = co_await acceptor.accept();
      auto stream = co_await accept_tls(std::move(socket), context);
      if (!stream) result.first = stream.error();
    };
    const auto ask = [&]() -> asio::awaitable<void> {
      auto socket = co_await connect(acceptor.endpoint());
      co_await asio::async_write(*socket, asio::buffer(bytes), asio::use_awaitable);
      std::array<char, 100> piece;
      const auto [error, size] = co_await asio::async_read(*socket, asio::buffer(piece),
                                                           asio::as_tuple(asio::use_awaitable));
      result.second.assign(piece.data(), size);
    };
    asio::co_spawn(loop_, serve(), asio::detached);
    asio::co_spawn(loop_, ask(), asio::detached);
    loop_.run();
    loop_.restart();
    return result;
  }
};

}  // namespace

TEST_F(Tls, WhatIsSaidArrivesWhateverItsLength) {
  for (const std::size_t size : {std::size_t{1}, std::size_t{16384}, std::size_t{5'000'000}}) {
    std::string words(size, 'x');
    for (std::size_t i = 0; i < size; ++i) words[i] = static_cast<char>(i * 31 >> 3);
    const auto meeting =
        meet(server(), client({certificates_.authority(), {}}), "localhost", words);
    EXPECT_FALSE(meeting.server || meeting.client);
    EXPECT_TRUE(meeting.heard == words);
  }
}

TEST_F(Tls, AServerIsTrustedByItsAuthorityAndItsName) {
  const TlsTrust trust{certificates_.authority(), {}};
  EXPECT_FALSE(meet(server(), client(trust), "localhost").client);
  EXPECT_FALSE(meet(server(), client(trust), "127.0.0.1").client);
  for (const char* other : {"example.org", "127.0.0.2", "localhost.example.org"}) {
    const auto meeting = meet(server(), client(trust), other);
    ASSERT_TRUE(meeting.client) << other;
    EXPECT_EQ(meeting.client->kind, TlsError::Kind::untrusted);
    EXPECT_TRUE(meeting.server);
  }
}

TEST_F(Tls, AnUnknownAuthorityIsNotTrustedAndItsFingerprintIsSaid) {
  const auto meeting = meet(server(), client({}));
  ASSERT_TRUE(meeting.client);
  EXPECT_EQ(meeting.client->kind, TlsError::Kind::untrusted);
  EXPECT_EQ(meeting.client->fingerprint, certificates_.fingerprint("server"));
  EXPECT_NE(meeting.client->message.find("issuer"), std::string::npos) << meeting.client->message;
  EXPECT_EQ(meeting.heard, "");
}

TEST_F(Tls, APinnedCertificateNeedsNeitherAuthorityNorName) {
  const std::string sum = certificates_.fingerprint("server");
  const auto meeting = meet(server(), client({{}, sum}), "example.org");
  EXPECT_FALSE(meeting.client);
  EXPECT_EQ(meeting.client_sees.value().fingerprint, sum);
  std::string other = sum;
  other[0] = other[0] == '0' ? '1' : '0';
  const auto refused = meet(server(), client({certificates_.authority(), other}));
  ASSERT_TRUE(refused.client);
  EXPECT_EQ(refused.client->kind, TlsError::Kind::untrusted);
}

TEST_F(Tls, AClientMayShowACertificateWhichHasToBeSigned) {
  const TlsIdentity ann = certificates_.sign("ann", "email:ann@example.org,DNS:ann-desk");
  const TlsTrust trust{certificates_.authority(), {}};
  EXPECT_FALSE(meet(server(), client(trust, ann)).server_sees) << "it was not asked for";

  const auto known = meet(server(certificates_.authority()), client(trust, ann));
  ASSERT_TRUE(known.server_sees);
  EXPECT_EQ(known.server_sees->names,
            (std::vector<std::string>{"ann", "ann@example.org", "ann-desk"}));
  const auto nobody = meet(server(certificates_.authority()), client(trust));
  EXPECT_FALSE(nobody.server || nobody.server_sees);

  test::Certificates elsewhere;
  const auto stranger =
      meet(server(certificates_.authority()), client(trust, elsewhere.sign("ann", "DNS:ann")));
  EXPECT_TRUE(stranger.server);
  EXPECT_EQ(stranger.heard, "");
}

TEST_F(Tls, PlainWordsAreNoTls) {
  v1::Envelope hello;
  hello.mutable_hello()->set_protocol_version(1);
  for (const std::string& words : {encode_frame(hello.SerializeAsString()), std::string(64, '\0'),
                                   std::string("GET / HTTP/1.1\r\n\r\n")}) {
    const auto [error, answer] = say_plainly(words);
    EXPECT_EQ(error.kind, TlsError::Kind::no_tls) << error.message;
    EXPECT_EQ(error.message, "the client speaks no TLS");
    // An alert, which a reader of frames knows for one.
    FrameDecoder decoder;
    decoder.feed(answer);
    EXPECT_EQ(decoder.next().error(), FrameError::tls);
  }
}

TEST_F(Tls, OlderVersionsAreRefused) {
  auto acceptor = Acceptor::listen(loop_.get_executor(), parse_endpoint("0").value()).value();
  const auto context = server();
  for (const auto& [version, works] : {std::pair("-tls1_2", false), std::pair("-tls1_3", true)}) {
    std::optional<TlsStream> accepted;
    const auto serve = [&]() -> asio::awaitable<void> {
      auto [error, socket] = co_await acceptor.accept();
      accepted.emplace(co_await accept_tls(std::move(socket), context));
    };
    asio::co_spawn(loop_, serve(), asio::detached);
    const std::string command = "openssl s_client -connect " + to_string(acceptor.endpoint()) +
                                " " + version + " > /dev/null 2>&1 < /dev/null &";
    ASSERT_EQ(std::system(command.c_str()), 0);
    loop_.run();
    loop_.restart();
    EXPECT_EQ(accepted.value().has_value(), works) << version;
  }
}

TEST_F(Tls, AHandshakeThatStandsStillCanBeEnded) {
  auto acceptor = Acceptor::listen(loop_.get_executor(), parse_endpoint("0").value()).value();
  const auto context = server();
  Abort abort;
  std::optional<TlsError> ended;
  const auto serve = [&]() -> asio::awaitable<void> {
    auto [error, socket] = co_await acceptor.accept();
    const auto stream = co_await accept_tls(std::move(socket), context, &abort);
    if (!stream) ended = stream.error();
  };
  const auto ask = [&]() -> asio::awaitable<void> {
    auto socket = co_await connect(acceptor.endpoint());
    co_await asio::async_write(*socket, asio::buffer("\x16\x03\x01", 3), asio::use_awaitable);
    while (!abort) co_await asio::post(asio::use_awaitable);
    abort();
    std::array<char, 1> byte;
    const auto [error, size] =
        co_await socket->async_read_some(asio::buffer(byte), asio::as_tuple(asio::use_awaitable));
    EXPECT_TRUE(error);
  };
  asio::co_spawn(loop_, serve(), asio::detached);
  asio::co_spawn(loop_, ask(), asio::detached);
  loop_.run();
  EXPECT_TRUE(ended);
  EXPECT_FALSE(abort);
}

TEST_F(Tls, FilesThatLackSomethingAreNamed) {
  const auto error = [](const auto& result) { return result.error().message; };
  const std::string gone = " can't be read: No such file or directory";
  EXPECT_EQ(error(TlsContext::server({"/nowhere.pem", "/nowhere.key"})), "/nowhere.pem" + gone);
  EXPECT_EQ(error(TlsContext::server({server_.certificate, "/nowhere.key"})),
            "/nowhere.key" + gone);
  EXPECT_EQ(error(TlsContext::client({"/nowhere.pem", {}}, {})), "/nowhere.pem" + gone);
  const TlsIdentity other = certificates_.sign("other", "DNS:other");
  EXPECT_EQ(error(TlsContext::server({server_.certificate, other.key})),
            other.key.string() + " is not the key of " + server_.certificate.string() +
                ": key values mismatch");
  EXPECT_EQ(error(TlsContext::server(server_, server_.key)).find(server_.key.string()), 0u);
  EXPECT_EQ(error(TlsContext::client({server_.key, {}}, {})).find(server_.key.string()), 0u);
}

}  // namespace metamer::wire
