#include "tools/supple/contact_sheet.h"

#include "tools/common/figure_file.h"
#include "tools/supple/command.h"
#include "tools/supple/render_stage.h"
#include "tools/supple/sheet_style.h"

#include <algorithm>
#include <cstdio>

namespace supple::tools {

namespace {

constexpr float kMargin = 0.06f;

std::string timeLabel(double seconds) {
    char text[32];
    std::snprintf(text, sizeof text, "%.2f s", seconds);
    return text;
}

/// Where the pieces of the sheet lie.
struct Layout {
    VkExtent2D cell;
    uint32_t columns;
    uint32_t rows;
    uint32_t label; ///< height of the line over each row; 0 without labels

    [[nodiscard]] uint32_t columnX(uint32_t column) const { return kSheetGap + column * (2 * cell.width + kSheetGap); }
    [[nodiscard]] uint32_t rowY(uint32_t row) const {
        return kSheetGap + label + row * (cell.height + label + kSheetGap);
    }
    [[nodiscard]] uint32_t width() const { return columnX(columns); }
    [[nodiscard]] uint32_t height() const { return kSheetGap + rows * (cell.height + label + kSheetGap); }
};

Result<std::vector<uint32_t>> chosenClips(const host::Figure& figure, const std::vector<std::string>& names) {
    std::vector<uint32_t> clips;
    for (const std::string& name : names) {
        const Result<uint32_t> clip = host::findClip(figure, name);
        if (!clip)
            return clip.error();
        clips.push_back(*clip);
    }
    if (names.empty()) {
        for (uint32_t i = 0; i < figure.clips().size(); ++i)
            clips.push_back(i);
    }
    if (clips.empty())
        clips.push_back(SUPPLE_BIND_POSE);
    return clips;
}

std::string clipName(const host::Figure& figure, uint32_t clip) {
    return clip == SUPPLE_BIND_POSE ? "bind pose" : printable(figure.clips()[clip].name);
}

/// Times without the clip's end, which in a cycle is its beginning again.
std::vector<ClipTime> columnTimes(const host::Figure& figure, uint32_t clip, uint32_t columns) {
    std::vector<ClipTime> times;
    for (uint32_t column = 0; column < columns; ++column)
        // Off the simple fractions, where a clip of two cycles would show the same two poses twice.
        times.push_back({clip, figure.clipDuration(clip) * (column + 0.5) / (columns + 0.5)});
    return times;
}

Status drawRow(Stage& stage, const ContactSheetOptions& options, const Layout& layout, uint32_t row, uint32_t clip,
               host::Scene scene, host::Picture& sheet) {
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
        host::frameCamera(cage->points, radians(options.draw.yaw), radians(options.draw.pitch), aspect, kMargin);
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
            sheet.paste(*picture, layout.columnX(column) + (asCage ? 0 : layout.cell.width), layout.rowY(row));
        }
        if (layout.label > 0) {
            const uint32_t x = layout.columnX(column) + 4;
            const uint32_t y = layout.rowY(row) - layout.label + 2;
            if (column == 0)
                sheet.drawText(x, y, clipName(stage.figure(), clip), 2, kSheetInk);
            sheet.drawText(x + layout.cell.width, y, timeLabel(times[column].time), 2, kSheetFaintInk);
        }
    }
    return success();
}

Status drawSheet(Session& session, const ContactSheetOptions& options, VkExtent2D cell, uint32_t view) {
    Result<std::unique_ptr<Stage>> opened = Stage::open(session, options.file, cell, options.draw);
    if (!opened)
        return opened.error();
    Stage& stage = **opened;
    const Result<std::vector<uint32_t>> clips = chosenClips(stage.figure(), options.clips);
    if (!clips)
        return clips.error();
    const Layout layout{cell, options.columns, static_cast<uint32_t>(clips->size()),
                        options.labels ? kSheetLabelHeight : 0};
    host::Picture sheet = blankSheet(layout.width(), layout.height());
    host::Scene scene;
    scene.view = view;
    scene.pixelScale = pixelScale(cell);
    for (uint32_t row = 0; row < layout.rows; ++row) {
        const uint32_t clip = (*clips)[row];
        if (const Status status = drawRow(stage, options, layout, row, clip, scene, sheet); !status)
            return status.error();
        if (options.progress) {
            std::printf("%u/%u %s\n", row + 1, layout.rows, clipName(stage.figure(), clip).c_str());
            std::fflush(stdout);
        }
    }
    return host::writePng(sheet, options.output);
}

} // namespace

int runContactSheet(const ContactSheetOptions& options) {
    const Result<VkExtent2D> cell = parseSize(options.cell);
    if (!cell)
        return fail(kExitUsage, "--cell: " + cell.error().message);
    const Result<uint32_t> view = parseView(options.draw.view);
    if (!view)
        return fail(kExitUsage, "--view: " + view.error().message);
    if (options.columns == 0)
        return fail(kExitUsage, "--columns: at least one");
    return withSession(deviceFlags(options.draw),
                       [&](Session& session) { return drawSheet(session, options, *cell, *view); });
}

} // namespace supple::tools
