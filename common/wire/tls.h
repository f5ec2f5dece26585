#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>

#include "common/problem.h"
#include "common/wire/stream.h"

/// TLS 1.3 and nothing older (RFC 8446), by OpenSSL; only tls.cpp knows it.
namespace metamer::wire {

/// PEM files. A certificate's file may hold those that lead to its issuer, too.
struct TlsIdentity {
  std::filesystem::path certificate;
  std::filesystem::path key;
};

/// How a client knows a server. Nothing set: by the certificates that the system trusts, and its
/// name.
struct TlsTrust {
  std::filesystem::path authorities;  ///< A PEM file instead of the system's.
  std::string fingerprint;  ///< SHA-256 of the certificate itself, 64 hexadecimal digits; then no
                            ///< authority, name or date matters.
};

/// What is set up once for many connections.
class TlsContext {
 public:
  /// `client_authorities`, a PEM file, or empty: then no certificate is asked for. A client may
  /// have none; one that nobody in the file has signed ends the handshake. Errors: what a file
  /// lacks, a key that is not the certificate's.
  static Result<TlsContext> server(const TlsIdentity& identity,
                                   const std::filesystem::path& client_authorities = {});
  /// `identity` shows who the client is; its files may be empty. Errors: likewise.
  static Result<TlsContext> client(const TlsTrust& trust, const TlsIdentity& identity = {});

  struct Native;
  const std::shared_ptr<Native>& native() const { return native_; }

 private:
  explicit TlsContext(std::shared_ptr<Native> native) : native_(std::move(native)) {}
  std::shared_ptr<Native> native_;
};

struct TlsError {
  enum class Kind {
    no_tls,     ///< What the peer says is no TLS.
    untrusted,  ///< Its certificate is not to be trusted.
    failed,     ///< It refused, speaks another version, or is gone.
  };
  Kind kind = Kind::failed;
  std::string message;
  std::string fingerprint;  ///< Of a server's certificate that is not trusted.
};

using TlsStream = tl::expected<std::unique_ptr<Stream>, TlsError>;

/// Shakes hands; has no time limit of its own. Closing the socket through `abort`, which is set
/// meanwhile, ends it.
using Abort = std::function<void()>;
asio::awaitable<TlsStream> accept_tls(Socket socket, TlsContext context, Abort* abort = nullptr);
/// `host` is the name, or the address, that the server's certificate has to be for.
asio::awaitable<TlsStream> connect_tls(Socket socket, TlsContext context, std::string host,
                                       Abort* abort = nullptr);

}  // namespace metamer::wire
