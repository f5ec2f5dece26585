#pragma once

#include <list>
#include <memory>
#include <string>

#include "metamer/v1/session.pb.h"
#include "server/gl/context.h"
#include "server/gl/geometry.h"
#include "server/gl/programs.h"

namespace metamer::gl {

/// What a worker keeps for all its jobs: a context, the programs compiled in it and the geometry
/// uploaded to it last. Belongs to the thread in which its context is current.
class Device {
 public:
  /// `which` as Context::create has it. Looks at what the device can do, before anything relies on
  /// it. Errors: no such device, no driver, or loops that end too early for any scene.
  static Result<Device> create(const std::string& which);

  const Context& context() const { return context_; }
  const v1::GlCapabilities& capabilities() const { return capabilities_; }
  ProgramCache& programs() { return programs_; }

  /// A scene's geometry, uploaded the first time; `key` names all that it depends on.
  Result<std::shared_ptr<const Geometry>> geometry(const std::string& key, const RenderScene& scene,
                                                   const std::atomic<bool>& cancelled);
  /// How often one was uploaded.
  std::size_t uploads() const { return uploads_; }

 private:
  struct Known {
    std::string key;
    std::shared_ptr<const Geometry> geometry;
  };
  static constexpr std::size_t most = 4;  ///< Scenes whose geometry is kept.

  explicit Device(Context context) : context_(std::move(context)) {}

  Context context_;  // outlives what was made in it
  v1::GlCapabilities capabilities_;
  ProgramCache programs_;
  std::list<Known> known_;  ///< Used last first.
  std::size_t uploads_ = 0;
};

}  // namespace metamer::gl
