#include "tools/supple/contact_sheet.h"
#include "tools/supple/progress.h"

#include "host/png_writer.h"
#include "tools/common/figure_file.h"
#include "tools/supple/command.h"
#include "tools/supple/render_stage.h"
#include "tools/supple/sheet_style.h"

#include <algorithm>
#include <cstdio>

namespace supple::tools {

namespace {

constexpr float kTileMargin = 0.06f;

std::string timeLabel(double seconds) {
    char text[32];
    std::snprintf(text, sizeof text, "%.2f s", seconds);
    return text;
}

/// Where the pieces of the sheet lie.
struct Layout {
    VkExtent2D cell;
    uint32_t columns;
    uint32_t label; ///< height of the line over each row; 0 without labels

    [[nodiscard]] uint32_t columnX(uint32_t column) const { return kSheetGap + column * (2 * cell.width + kSheetGap); }
    [[nodiscard]] uint32_t width() const { return columnX(columns); }
    [[nodiscard]] uint32_t rowHeight() const { return label + cell.height + kSheetGap; }
    [[nodiscard]] uint32_t height(size_t rows) const { return kSheetGap + static_cast<uint32_t>(rows) * rowHeight(); }
};

/// The clip of that name or index, else those of a list with commas.
Status findClips(const host::Figure& figure, const std::string& names, std::vector<uint32_t>& clips) {
    const size_t comma = names.find(',');
    const Result<uint32_t> whole = host::findClip(figure, names);
    if (whole || comma == std::string::npos) {
        if (whole)
            clips.push_back(*whole);
        return whole ? success() : Status(whole.error());
    }
    if (const Status status = findClips(figure, names.substr(0, comma), clips); !status)
        return status.error();
    return findClips(figure, names.substr(comma + 1), clips);
}

Result<std::vector<uint32_t>> chosenClips(const host::Figure& figure, const std::vector<std::string>& lists) {
    std::vector<uint32_t> clips;
    for (const std::string& names : lists) {
        if (const Status status = findClips(figure, names, clips); !status)
            return status.error();
    }
    if (lists.empty()) {
        for (uint32_t i = 0; i < figure.clips().size(); ++i)
            clips.push_back(i);
    }
    if (clips.empty())
        clips.push_back(SUPPLE_REST_POSE);
    return clips;
}

std::string clipName(const host::Figure& figure, uint32_t clip) {
    return clip == SUPPLE_REST_POSE ? "rest pose" : printable(figure.clips()[clip].name);
}

/// Times without the clip's end, which in a cycle is its beginning again.
std::vector<ClipTime> columnTimes(const host::Figure& figure, uint32_t clip, uint32_t columns) {
    std::vector<ClipTime> times;
    for (uint32_t column = 0; column < columns; ++column)
        // Off the simple fractions, where a clip of two cycles would show the same two poses twice.
        times.push_back({clip, figure.clipDuration(clip) * (column + 0.5) / (columns + 0.5)});
    return times;
}

/// The pictures of a clip, with their labels above and a gap below.
Result<host::Picture> drawRow(Stage& stage, const ContactSheetOptions& options, const Layout& layout, uint32_t clip,
                              host::Scene scene) {
    host::Picture row = blankSheet(layout.width(), layout.rowHeight());
    const std::vector<ClipTime> times = columnTimes(stage.figure(), clip, layout.columns);
    // One camera and one floor a row, so that motion is seen as motion.
    const Result<Extent> surface = stage.measure(times, false);
    if (!surface)
        return surface.error();
    const Result<Extent> cage = stage.measure(times, true);
    if (!cage)
        return cage.error();
    const float aspect = static_cast<float>(layout.cell.width) / static_cast<float>(layout.cell.height);
    scene.camera =
        host::frameCamera(cage->points, radians(options.draw.yaw), radians(options.draw.pitch), aspect, kTileMargin);
    scene.lightYaw = scene.camera.yaw;
    for (uint32_t column = 0; column < layout.columns; ++column) {
        if (const Status status = stage.pose(times[column]); !status)
            return status.error();
        for (const bool asCage : {true, false}) {
            scene.bounds = (asCage ? cage : surface)->bounds;
            scene.ground.reset();
            if (options.draw.ground)
                scene.ground = scene.bounds.min.y;
            scene.cageFaces = asCage;
            scene.cageEdges = asCage || options.draw.cageOverlay;
            const Result<host::Picture> picture = stage.draw(scene);
            if (!picture)
                return picture.error();
            row.paste(*picture, layout.columnX(column) + (asCage ? 0 : layout.cell.width), layout.label);
        }
        if (layout.label > 0) {
            const uint32_t x = layout.columnX(column) + 4;
            constexpr uint32_t kTop = 2;
            if (column == 0)
                row.drawText(x, kTop, clipName(stage.figure(), clip), 2, kSheetInk);
            row.drawText(x + layout.cell.width, kTop, timeLabel(times[column].time), 2, kSheetFaintInk);
        }
    }
    return row;
}

Status drawSheet(Session& session, const ContactSheetOptions& options, VkExtent2D cell, uint32_t view) {
    Result<std::unique_ptr<Stage>> opened = Stage::open(session, options.file, cell, options.draw);
    if (!opened)
        return opened.error();
    Stage& stage = **opened;
    const Result<std::vector<uint32_t>> clips = chosenClips(stage.figure(), options.clips);
    if (!clips)
        return clips.error();
    const Layout layout{cell, options.columns, options.labels ? kSheetLabelHeight : 0};
    // Row by row, so that memory does not grow with the clips.
    host::PngWriter sheet(options.output, layout.width(), layout.height(clips->size()), host::PngAlpha::leftOut);
    if (const Status status = sheet.append(blankSheet(layout.width(), kSheetGap)); !status)
        return status.error();
    host::Scene scene;
    scene.view = view;
    fitToPixels(scene, cell);
    for (size_t i = 0; i < clips->size(); ++i) {
        const uint32_t clip = (*clips)[i];
        const Result<host::Picture> row = drawRow(stage, options, layout, clip, scene);
        if (!row)
            return row.error();
        if (const Status status = sheet.append(*row); !status)
            return status.error();
        if (options.progress) {
            std::printf("%zu/%zu %s\n", i + 1, clips->size(), clipName(stage.figure(), clip).c_str());
            std::fflush(stdout);
        }
    }
    return sheet.close();
}

} // namespace

int runContactSheet(const ContactSheetOptions& options) {
    const Result<PictureKind> cells = parsePicture("--cell", options.cell, options.draw.view);
    if (!cells)
        return fail(kExitUsage, cells.error().message);
    if (options.columns == 0)
        return fail(kExitUsage, "--columns: at least one");
    const int code = withSession(deviceFlags(options.draw), [&](Session& session) {
        return drawSheet(session, options, cells->size, cells->view);
    });
    if (code == kExitOk)
        tellWritten(options.output);
    return code;
}

} // namespace supple::tools
