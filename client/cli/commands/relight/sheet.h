#pragma once

#include <string>

#include "client/cli/commands/relight/relighting.h"
#include "client/tools/pictures/contact_sheet.h"

namespace metamer::cli {

/// The contact sheet of --sheet, which grows by pictures as Relighting hands them on.
class RelightSheet {
 public:
  RelightSheet(const RelightWork& work, bool maps, Report& report);

  /// Says how far the picture is from the first material's under its light; the document's last of
  /// `pictures` is this one.
  void add(const RelitPicture& picture);
  ExitCode write(const std::string& file);

 private:
  void add_difference(const RelitPicture& picture, client::SheetCell& cell);

  Report& report_;
  client::Sheet sheet_;
  Image reference_;  ///< Of the light that is at work, with the first material.
  Developing developing_;
};

}  // namespace metamer::cli
