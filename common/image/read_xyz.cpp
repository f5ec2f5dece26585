#include "common/image/read_xyz.h"

#include "common/image/picture_file.h"
#include "common/image/read_exr_xyz.h"
#include "common/image/read_png_xyz.h"

namespace metamer {

Result<XyzPicture> read_xyz(const std::filesystem::path& file, const Viewing& viewing,
                            const PictureChoice& choice) {
  if (const auto good = check_readable(file); !good) return tl::unexpected<Problem>(good.error());
  Result<XyzPicture> result =
      format_of(file) == "exr" ? read_exr_xyz(file, viewing, choice) : read_png_xyz(file);
  if (!result) return file_problem(file, result.error().message);
  return result;
}

}  // namespace metamer
