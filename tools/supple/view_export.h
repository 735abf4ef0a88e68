// What the viewer writes: pictures of what it shows, made beside it as supple render and supple animate make them.
#pragma once

#include "tools/supple/render_command_line.h"
#include "tools/supple/view_stage.h"

#include <future>
#include <string>

namespace supple::tools {

enum class ExportKind { picture, sequence, animation, commandLine };

struct ExportWish {
    ExportKind kind = ExportKind::picture;
    VkExtent2D size{};
    bool alpha = false;
};

/// The picture that the stage shows, but for a crossfade, which supple render does not have. `given`: of the viewer's
/// own command line. The figure stands in the middle also where a panel covers a part of the window.
[[nodiscard]] RenderOptions shownPicture(const ViewStage& stage, const DrawOptions& given, const ExportWish& wish);
/// Its clip as it plays.
[[nodiscard]] AnimateOptions shownClip(const ViewStage& stage, const DrawOptions& given, const ExportWish& wish);

/// A name that no file has yet: stem and ending, and a number between them where that is taken.
[[nodiscard]] std::string freeName(const std::string& stem, const std::string& ending);

/// Writes one thing at a time, on a thread and a device of its own.
class ViewExport {
public:
    /// Files are named after the figure's, in the folder the viewer runs in; none is written over.
    void start(const ViewStage& stage, const DrawOptions& given, const ExportWish& wish);
    [[nodiscard]] bool isBusy() const { return work_.valid(); }
    /// What is being written, or what became of the last thing.
    [[nodiscard]] const std::string& report();

private:
    std::future<Status> work_;
    std::string output_;
    std::string report_;
};

} // namespace supple::tools
