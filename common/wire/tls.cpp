#include "common/wire/tls.h"

#include <openssl/err.h>
#include <openssl/ssl.h>
#include <openssl/x509v3.h>

#include <array>
#include <cstring>

#include "common/wire/tls_native.h"

namespace metamer::wire {

std::string fingerprint_of(X509* certificate) {
  std::array<unsigned char, EVP_MAX_MD_SIZE> sum{};
  unsigned size = 0;
  X509_digest(certificate, EVP_sha256(), sum.data(), &size);
  constexpr const char* digits = "0123456789abcdef";
  std::string text;
  for (unsigned i = 0; i < size; ++i) {
    text += digits[sum[i] >> 4];
    text += digits[sum[i] & 15];
  }
  return text;
}

namespace {

/// The first thing that went wrong; OpenSSL has no words for what the system says.
tl::unexpected<Problem> bad_file(const std::filesystem::path& file, const std::string& lacks) {
  const unsigned long code = ERR_get_error();
  ERR_clear_error();
  if (ERR_SYSTEM_ERROR(code))
    return problem(file.string() + " can't be read: " + std::strerror(ERR_GET_REASON(code)));
  const char* words = code ? ERR_reason_error_string(code) : nullptr;
  return problem(file.string() + " " + lacks + ": " + (words ? words : "unknown reason"));
}

/// Only the certificate's own sum counts where one is pinned.
int verify_server(X509_STORE_CTX* store, void* context) {
  auto& native = *static_cast<TlsContext::Native*>(context);
  X509* shown = X509_STORE_CTX_get0_cert(store);
  native.shown = shown ? fingerprint_of(shown) : "";
  if (native.pinned.empty()) return X509_verify_cert(store);
  if (native.shown == native.pinned) return 1;
  X509_STORE_CTX_set_error(store, X509_V_ERR_CERT_UNTRUSTED);
  return 0;
}

void set_up(SSL_CTX* context) {
  SSL_CTX_set_min_proto_version(context, TLS1_3_VERSION);
  SSL_CTX_set_mode(context, SSL_MODE_RELEASE_BUFFERS | SSL_MODE_ENABLE_PARTIAL_WRITE |
                                SSL_MODE_ACCEPT_MOVING_WRITE_BUFFER);
  // Sessions are not resumed: they last for hours, and a ticket would outlive a revoked user.
  SSL_CTX_set_session_cache_mode(context, SSL_SESS_CACHE_OFF);
  SSL_CTX_set_num_tickets(context, 0);
  // An end without close_notify is an end: messages say themselves how long they are.
  SSL_CTX_set_options(context, SSL_OP_IGNORE_UNEXPECTED_EOF);
}

Result<void> use(SSL_CTX* context, const TlsIdentity& identity) {
  ERR_clear_error();
  if (SSL_CTX_use_certificate_chain_file(context, identity.certificate.c_str()) != 1)
    return bad_file(identity.certificate, "is no certificate");
  if (SSL_CTX_use_PrivateKey_file(context, identity.key.c_str(), SSL_FILETYPE_PEM) != 1)
    return bad_file(identity.key, "is not the key of " + identity.certificate.string());
  return {};
}

}  // namespace

Result<TlsContext> TlsContext::server(const TlsIdentity& identity,
                                      const std::filesystem::path& client_authorities) {
  auto native = std::make_shared<Native>(TLS_server_method());
  set_up(native->context);
  if (auto used = use(native->context, identity); !used) return tl::unexpected(used.error());
  if (!client_authorities.empty()) {
    STACK_OF(X509_NAME)* names = SSL_load_client_CA_file(client_authorities.c_str());
    if (!names || SSL_CTX_load_verify_file(native->context, client_authorities.c_str()) != 1)
      return bad_file(client_authorities, "has no certificates");
    SSL_CTX_set_client_CA_list(native->context, names);
    SSL_CTX_set_verify(native->context, SSL_VERIFY_PEER, nullptr);
  }
  return TlsContext(std::move(native));
}

Result<TlsContext> TlsContext::client(const TlsTrust& trust, const TlsIdentity& identity) {
  auto native = std::make_shared<Native>(TLS_client_method());
  set_up(native->context);
  SSL_CTX_set_verify(native->context, SSL_VERIFY_PEER, nullptr);
  SSL_CTX_set_cert_verify_callback(native->context, verify_server, native.get());
  native->pinned = trust.fingerprint;
  ERR_clear_error();
  if (!trust.fingerprint.empty()) {
    // No authority is needed.
  } else if (trust.authorities.empty()) {
    SSL_CTX_set_default_verify_paths(native->context);
  } else if (SSL_CTX_load_verify_file(native->context, trust.authorities.c_str()) != 1) {
    return bad_file(trust.authorities, "has no certificates");
  }
  if (!identity.certificate.empty())
    if (auto used = use(native->context, identity); !used) return tl::unexpected(used.error());
  return TlsContext(std::move(native));
}

}  // namespace metamer::wire
