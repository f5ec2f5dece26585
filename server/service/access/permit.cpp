#include "server/service/access/permit.h"

#include <utility>

namespace metamer::service {

v1::Role least_role(v1::Envelope::BodyCase request) {
  using Body = v1::Envelope;
  switch (request) {
    // Whoever is let in may look: at the server, and at what is its own. A view is looking, and
    // needs the scene's files; to end what is one's own takes nothing from anybody.
    case Body::kHello:
    case Body::kPing:
    case Body::kGetInfo:
    case Body::kListJobs:
    case Body::kWatch:
    case Body::kUnwatch:
    case Body::kOfferAssets:
    case Body::kAssetChunk:
    case Body::kOpenView:
    case Body::kUpdateView:
    case Body::kNextFrame:
    case Body::kProbe:
    case Body::kCloseView:
    case Body::kCancel:
    case Body::kPause:
      return v1::VIEWER;
    // What sets workers to work for long.
    case Body::kSubmit:
    case Body::kResume:
    case Body::kPrioritize:
      return v1::SUBMITTER;
    // The server's to send.
    case Body::kWelcome:
    case Body::kPong:
    case Body::kInfo:
    case Body::kMissingAssets:
    case Body::kAssetStored:
    case Body::kSubmitted:
    case Body::kJobEvent:
    case Body::kJobList:
    case Body::kJobSummary:
    case Body::kError:
    case Body::kViewEvent:
    case Body::kUnwatched:
    case Body::BODY_NOT_SET:
      return v1::ROLE_UNSPECIFIED;
  }
  return v1::ROLE_UNSPECIFIED;
}

tl::expected<void, Refusal> permit(const Identity& identity, v1::Envelope::BodyCase request) {
  const v1::Role least = least_role(request);
  // What nobody may is refused by its own name: UNKNOWN_MESSAGE.
  if (least == v1::ROLE_UNSPECIFIED || identity.role >= least) return {};
  return refuse(v1::Error::FORBIDDEN, identity.user + " is a " + word(identity.role) +
                                          ", and that takes a " + word(least));
}

namespace {

constexpr std::pair<v1::Role, const char*> role_words[] = {
    {v1::VIEWER, "viewer"}, {v1::SUBMITTER, "submitter"}, {v1::ADMIN, "admin"}};

}  // namespace

const char* word(v1::Role role) {
  for (const auto& [known, text] : role_words)
    if (known == role) return text;
  return "nobody";
}

v1::Role role_of(std::string_view text) {
  for (const auto& [role, known] : role_words)
    if (text == known) return role;
  return v1::ROLE_UNSPECIFIED;
}

}  // namespace metamer::service
