#pragma once

namespace metamer {

/// Which commit this program was built from, as `git describe --always --dirty` says it; the
/// version where there is no repository. In a source that each build makes anew, and that alone is
/// compiled anew where it has changed.
const char* build_id();

}  // namespace metamer
