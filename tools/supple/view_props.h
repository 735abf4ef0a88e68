// What the viewer attaches where it is clicked: a lantern, an arrow, a sticker.
#pragma once

#include "host/attachments.h"

#include <vector>

namespace supple::tools {

enum class Prop { none, lantern, arrow, sticker };

/// A prop or a decal on a figure.
struct AttachedProp {
    Prop prop = Prop::none;
    SuppleSurfacePoint at{};
};

/// Triangles of a thing of unit length along z. A lantern begins at its foot, an arrow 0.2 behind its point.
[[nodiscard]] std::vector<host::shared::AttachmentVertex> lanternVertices();
[[nodiscard]] std::vector<host::shared::AttachmentVertex> arrowVertices();
/// A round sticker with a star and a rim that stands up.
[[nodiscard]] host::DecalLook stickerLook();

/// `radius`: of the figure.
[[nodiscard]] Status attach(host::Attachments& to, const AttachedProp& what, float radius);

} // namespace supple::tools
