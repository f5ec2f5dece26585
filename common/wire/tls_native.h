#pragma once

#include <openssl/ssl.h>

#include <string>

#include "common/wire/tls.h"

// For tls.cpp and tls_stream.cpp alone: what is OpenSSL's.
namespace metamer::wire {

struct TlsContext::Native {
  explicit Native(const SSL_METHOD* method) : context(SSL_CTX_new(method)) {}
  ~Native() { SSL_CTX_free(context); }
  Native(const Native&) = delete;
  Native& operator=(const Native&) = delete;

  SSL_CTX* context;
  std::string pinned;  // a client's; empty: the chain is verified
  std::string shown;   // what a server has shown to a client, trusted or not
};

/// SHA-256 of a certificate, as hex.
std::string fingerprint_of(X509* certificate);

}  // namespace metamer::wire
