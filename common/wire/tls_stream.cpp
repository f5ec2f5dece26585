// A connection by TLS: the handshake, and what goes over it.
#include <openssl/bio.h>
#include <openssl/err.h>
#include <openssl/ssl.h>
#include <openssl/x509v3.h>
#include <sys/socket.h>

#include <array>
#include <boost/asio/ssl/error.hpp>
#include <cerrno>
#include <optional>

#include "common/wire/tls_native.h"

namespace metamer::wire {

namespace {

using boost::system::error_code;

struct FreeTls {
  void operator()(SSL* tls) const { SSL_free(tls); }
  void operator()(X509* certificate) const { X509_free(certificate); }
  void operator()(GENERAL_NAMES* names) const { GENERAL_NAMES_free(names); }
};

std::string text_of(const ASN1_STRING* string) {
  unsigned char* bytes = nullptr;
  const int size = ASN1_STRING_to_UTF8(&bytes, string);
  if (size < 0) return {};
  std::string text(reinterpret_cast<const char*>(bytes), static_cast<std::size_t>(size));
  OPENSSL_free(bytes);
  return text;
}

PeerCertificate read_certificate(X509* certificate) {
  PeerCertificate read{fingerprint_of(certificate), {}};
  const X509_NAME* subject = X509_get_subject_name(certificate);
  const int at = X509_NAME_get_index_by_NID(subject, NID_commonName, -1);
  if (at >= 0)
    read.names.push_back(text_of(X509_NAME_ENTRY_get_data(X509_NAME_get_entry(subject, at))));
  const std::unique_ptr<GENERAL_NAMES, FreeTls> others(static_cast<GENERAL_NAMES*>(
      X509_get_ext_d2i(certificate, NID_subject_alt_name, nullptr, nullptr)));
  for (int i = 0; others && i < sk_GENERAL_NAME_num(others.get()); ++i) {
    const GENERAL_NAME* name = sk_GENERAL_NAME_value(others.get(), i);
    if (name->type == GEN_DNS || name->type == GEN_EMAIL)
      read.names.push_back(text_of(name->d.ia5));
  }
  return read;
}

/// The socket as OpenSSL's BIO: its own would raise SIGPIPE.
class SocketBio {
 public:
  static BIO* make(Socket& socket) {
    BIO* bio = BIO_new(method());
    BIO_set_data(bio, &socket);
    BIO_set_init(bio, 1);
    return bio;
  }

 private:
  static const BIO_METHOD* method() {
    static const BIO_METHOD* const methods = [] {
      BIO_METHOD* made = BIO_meth_new(BIO_get_new_index() | BIO_TYPE_SOURCE_SINK, "socket");
      BIO_meth_set_read(made, read);
      BIO_meth_set_write(made, write);
      BIO_meth_set_ctrl(made, control);
      return made;
    }();
    return methods;
  }
  static int handle(BIO* bio) { return static_cast<Socket*>(BIO_get_data(bio))->native_handle(); }
  static int taken(BIO* bio, ssize_t bytes, int flag) {
    BIO_clear_retry_flags(bio);
    if (bytes < 0 && (errno == EINTR || errno == EAGAIN)) BIO_set_flags(bio, flag);
    return static_cast<int>(bytes);
  }
  static int read(BIO* bio, char* data, int size) {
    const auto got = ::recv(handle(bio), data, static_cast<std::size_t>(size), MSG_DONTWAIT);
    return taken(bio, got, BIO_FLAGS_READ | BIO_FLAGS_SHOULD_RETRY);
  }
  static int write(BIO* bio, const char* data, int size) {
    const auto sent =
        ::send(handle(bio), data, static_cast<std::size_t>(size), MSG_DONTWAIT | MSG_NOSIGNAL);
    return taken(bio, sent, BIO_FLAGS_WRITE | BIO_FLAGS_SHOULD_RETRY);
  }
  static long control(BIO*, int command, long, void*) { return command == BIO_CTRL_FLUSH; }
};

/// OpenSSL on the socket itself. Asio's own stream keeps 68 KiB of buffers for every connection,
/// idle or not; this keeps none (SSL_MODE_RELEASE_BUFFERS).
class EncryptedStream final : public Stream {
 public:
  EncryptedStream(Socket socket, TlsContext context)
      : socket_(std::move(socket)),
        context_(std::move(context)),
        tls_(SSL_new(context_.native()->context)) {
    BIO* bio = SocketBio::make(socket_);
    SSL_set_bio(tls_.get(), bio, bio);
  }

  SSL* native() { return tls_.get(); }
  Socket& socket() { return socket_; }

  /// SSL_accept or SSL_connect, to its end.
  asio::awaitable<error_code> shake_hands() {
    while (true) {
      ERR_clear_error();
      const Taken step = done(SSL_do_handshake(tls_.get()), reading_);
      if (step.first != asio::error::would_block) co_return step.first;
      if (const error_code error = co_await wait(reading_)) co_return error;
    }
  }

  /// Says to who speaks no TLS that it is spoken here, by the alert protocol_version (RFC
  /// 8446, 6.2), which OpenSSL leaves out, and reads until the peer has closed: closing with bytes
  /// unread would take that from it.
  asio::awaitable<void> say_what_is_spoken() {
    constexpr std::array<unsigned char, 7> alert{0x15, 3, 3, 0, 2, 2, 70};
    ::send(socket_.native_handle(), alert.data(), alert.size(), MSG_DONTWAIT | MSG_NOSIGNAL);
    error_code error;
    socket_.shutdown(asio::socket_base::shutdown_send, error);
    std::array<char, 1024> piece;
    while (!error) {
      error = co_await wait(asio::socket_base::wait_read);
      const auto got = ::recv(socket_.native_handle(), piece.data(), piece.size(), MSG_DONTWAIT);
      if (got == 0 || (got < 0 && errno != EAGAIN && errno != EINTR)) co_return;
    }
  }

  void remember_certificate() {
    const std::unique_ptr<X509, FreeTls> shown(SSL_get1_peer_certificate(tls_.get()));
    if (shown) certificate_ = read_certificate(shown.get());
  }

  Taken read(char* data, std::size_t size) override {
    ERR_clear_error();
    errno = 0;
    return done(SSL_read(tls_.get(), data, static_cast<int>(size)), reading_);
  }
  Taken write(const char* data, std::size_t size) override {
    ERR_clear_error();
    errno = 0;
    return done(SSL_write(tls_.get(), data, static_cast<int>(std::min(size, most))), writing_);
  }
  asio::awaitable<error_code> wait_to_read() override { return wait(reading_); }
  asio::awaitable<error_code> wait_to_write() override { return wait(writing_); }

  void shutdown_send() override {
    say_goodbye();
    error_code ignored;
    socket_.shutdown(asio::socket_base::shutdown_send, ignored);
  }
  void shutdown_receive() override {
    error_code ignored;
    socket_.shutdown(asio::socket_base::shutdown_receive, ignored);
  }
  void close() override {
    if (socket_.is_open()) say_goodbye();
    error_code ignored;
    socket_.close(ignored);
  }
  bool is_open() const override { return socket_.is_open(); }
  asio::any_io_executor executor() override { return socket_.get_executor(); }
  const PeerCertificate* certificate() const override {
    return certificate_ ? &*certificate_ : nullptr;
  }

 private:
  static constexpr std::size_t most = std::size_t{1} << 30;

  /// What OpenSSL did, and, where it has to wait, for what.
  Taken done(int result, asio::socket_base::wait_type& waits) {
    if (result > 0) return {error_code(), static_cast<std::size_t>(result)};
    const int system = errno;
    switch (SSL_get_error(tls_.get(), result)) {
      case SSL_ERROR_WANT_READ:
        waits = asio::socket_base::wait_read;
        return {asio::error::would_block, 0};
      case SSL_ERROR_WANT_WRITE:
        waits = asio::socket_base::wait_write;
        return {asio::error::would_block, 0};
      case SSL_ERROR_ZERO_RETURN:
        return {asio::error::eof, 0};
      case SSL_ERROR_SYSCALL:
        if (result == 0 || system == 0) return {asio::error::eof, 0};
        return {error_code(system, boost::system::system_category()), 0};
      default:
        return {error_code(static_cast<int>(ERR_peek_error()), asio::error::get_ssl_category()), 0};
    }
  }

  asio::awaitable<error_code> wait(asio::socket_base::wait_type what) {
    const auto [error] = co_await socket_.async_wait(what, asio::as_tuple(asio::use_awaitable));
    co_return error;
  }

  /// close_notify, once, where the socket has room: whoever is gone need not hear it.
  void say_goodbye() {
    if (SSL_is_init_finished(tls_.get())) SSL_shutdown(tls_.get());
    ERR_clear_error();
  }

  Socket socket_;
  TlsContext context_;
  std::unique_ptr<SSL, FreeTls> tls_;
  std::optional<PeerCertificate> certificate_;
  asio::socket_base::wait_type reading_ = asio::socket_base::wait_read;
  asio::socket_base::wait_type writing_ = asio::socket_base::wait_write;
};

TlsError failure(EncryptedStream& stream, const error_code& error, const char* peer,
                 const std::string& shown) {
  TlsError result;
  result.message = error.message();
  const unsigned long code = ERR_peek_error();
  const bool ssl = error.category() == asio::error::get_ssl_category();
  const int reason = ssl ? ERR_GET_REASON(static_cast<unsigned long>(error.value())) : 0;
  ERR_clear_error();
  if (reason == SSL_R_WRONG_VERSION_NUMBER || reason == SSL_R_HTTP_REQUEST ||
      reason == SSL_R_PACKET_LENGTH_TOO_LONG || reason == SSL_R_BAD_RECORD_TYPE) {
    result.kind = TlsError::Kind::no_tls;
    result.message = std::string("the ") + peer + " speaks no TLS";
  } else if (reason == SSL_R_CERTIFICATE_VERIFY_FAILED) {
    result.kind = TlsError::Kind::untrusted;
    result.message = X509_verify_cert_error_string(SSL_get_verify_result(stream.native()));
    result.fingerprint = shown;
  } else if (error == asio::error::eof) {
    result.message = std::string("the ") + peer + " closed the connection";
  } else if (code != 0 && ssl) {
    if (const char* words = ERR_reason_error_string(code)) result.message = words;
  }
  return result;
}

/// Both ends' way: `stream` is set up, and has to be shown a certificate or not.
asio::awaitable<TlsStream> shaken(std::unique_ptr<EncryptedStream> stream, const char* peer,
                                  TlsContext context, Abort* abort, bool answers) {
  // However the handshake ends, nothing of it can be ended afterwards.
  const std::shared_ptr<void> over(nullptr, [abort](void*) {
    if (abort) *abort = {};
  });
  if (abort) *abort = [raw = stream.get()] { raw->close(); };
  const error_code error = co_await stream->shake_hands();
  if (error) {
    TlsError result = failure(*stream, error, peer, context.native()->shown);
    if (answers && result.kind == TlsError::Kind::no_tls) co_await stream->say_what_is_spoken();
    co_return tl::unexpected(std::move(result));
  }
  stream->remember_certificate();
  co_return std::unique_ptr<Stream>(std::move(stream));
}

}  // namespace

asio::awaitable<TlsStream> accept_tls(Socket socket, TlsContext context, Abort* abort) {
  auto stream = std::make_unique<EncryptedStream>(std::move(socket), context);
  SSL_set_accept_state(stream->native());
  co_return co_await shaken(std::move(stream), "client", std::move(context), abort, true);
}

asio::awaitable<TlsStream> connect_tls(Socket socket, TlsContext context, std::string host,
                                       Abort* abort) {
  auto stream = std::make_unique<EncryptedStream>(std::move(socket), context);
  SSL* tls = stream->native();
  SSL_set_connect_state(tls);
  error_code no_address;
  asio::ip::make_address(host, no_address);
  if (no_address) {
    SSL_set_tlsext_host_name(tls, host.c_str());
    SSL_set1_host(tls, host.c_str());
  } else {
    X509_VERIFY_PARAM_set1_ip_asc(SSL_get0_param(tls), host.c_str());
  }
  co_return co_await shaken(std::move(stream), "server", std::move(context), abort, false);
}

}  // namespace metamer::wire
