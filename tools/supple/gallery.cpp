#include "tools/supple/gallery.h"

#include "tools/common/gallery_cages.h"
#include "tools/supple/command.h"
#include "tools/supple/legend.h"
#include "tools/supple/output_files.h"
#include "tools/supple/progress.h"
#include "tools/supple/render_stage.h"
#include "tools/supple/sheet_style.h"

#include <algorithm>
#include <cstdio>
#include <optional>
#include <vector>

namespace supple::tools {
namespace {

constexpr float kGalleryMargin = 0.04f;
constexpr uint32_t kLegendHeight = 64;

std::vector<std::string> galleryColumns() {
    std::vector<std::string> names = {"cage"};
    for (const Scheme& scheme : kSchemes) {
        if (scheme.smooth)
            names.emplace_back(scheme.name);
    }
    return names;
}

/// All, or those whose names begin so.
std::vector<cage::GalleryCage> chosenCages(const std::string& only) {
    std::vector<cage::GalleryCage> cages = cage::galleryCages();
    std::erase_if(cages,
                  [&](const cage::GalleryCage& subject) { return std::string(subject.name).rfind(only, 0) != 0; });
    return cages;
}

host::CharacterFile characterOf(const cage::GalleryCage& subject) {
    host::CharacterFile file;
    file.path = subject.name;
    file.character.name = subject.name;
    file.character.cage = subject.cage;
    return file;
}

/// A cage under one scheme, or itself. None: the scheme does not take it.
Result<std::unique_ptr<Stage>> openOne(Session& session, const cage::GalleryCage& subject, const std::string& scheme,
                                       VkExtent2D cell, DrawOptions draw, Extent& extent) {
    draw.scheme = scheme;
    Result<std::unique_ptr<Stage>> stage = Stage::open(session, characterOf(subject), cell, draw);
    if (!stage) {
        const bool refused = stage.error().code == ErrorCode::asset || stage.error().code == ErrorCode::limit;
        return refused ? Result<std::unique_ptr<Stage>>(nullptr) : stage.error();
    }
    const ClipTime pose[] = {ClipTime{}};
    Result<Extent> measured = (*stage)->measure(pose, scheme == "cage");
    if (!measured)
        return measured.error();
    extent = std::move(*measured);
    return std::move(*stage);
}

/// All schemes see a cage from one place, and the same light.
Status drawRow(Session& session, const cage::GalleryCage& subject, const GalleryOptions& options, VkExtent2D cell,
               uint32_t view, uint32_t top, host::Picture& sheet) {
    const std::vector<std::string> columns = galleryColumns();
    host::Scene scene;
    fitToPixels(scene, cell);
    for (uint32_t column = 0; column < columns.size(); ++column) {
        Extent extent;
        const Result<std::unique_ptr<Stage>> stage =
            openOne(session, subject, columns[column], cell, options.draw, extent);
        if (!stage)
            return stage.error();
        const uint32_t left = kSheetGap + column * (cell.width + kSheetGap);
        if (!*stage) {
            sheet.drawText(left + 8, top + cell.height / 2, "does not take it", 1, kSheetFaintInk);
            continue;
        }
        scene.bounds = extent.bounds;
        if (column == 0) { // the cage encloses the surfaces
            const float aspect = static_cast<float>(cell.width) / static_cast<float>(cell.height);
            scene.camera = host::frameCamera(extent.points, radians(options.draw.yaw), radians(options.draw.pitch),
                                             aspect, kGalleryMargin);
            scene.lightYaw = scene.camera.yaw;
        }
        scene.view = column == 0 ? uint32_t{host::shared::kViewShaded} : view;
        scene.cageFaces = column == 0;
        scene.cageEdges = column == 0 || options.draw.cageOverlay;
        const Result<host::Picture> picture = (*stage)->draw(scene);
        if (!picture)
            return picture.error();
        sheet.paste(*picture, left, top);
    }
    return success();
}

/// The scale that all pictures have in common.
std::optional<Legend> scaleOf(uint32_t view) {
    ViewFacts facts;
    facts.occlusionMaps = facts.jointMoves = true;
    std::optional<Legend> legend = legendOf(view, facts);
    return legend && legend->bar != Legend::Bar::none ? legend : std::nullopt;
}

Status drawGallery(Session& session, const GalleryOptions& options, VkExtent2D cell, uint32_t view) {
    const std::vector<cage::GalleryCage> cages = chosenCages(options.only);
    const std::vector<std::string> columns = galleryColumns();
    const uint32_t step = kSheetLabelHeight + cell.height + kSheetGap;
    const auto across = static_cast<uint32_t>(columns.size()), down = static_cast<uint32_t>(cages.size());
    const std::optional<Legend> legend = scaleOf(view);
    host::Picture sheet = blankSheet(kSheetGap + across * (cell.width + kSheetGap),
                                     kSheetGap + kSheetLabelHeight + down * step + (legend ? kLegendHeight : 0));
    for (uint32_t column = 0; column < across; ++column)
        sheet.drawText(kSheetGap + column * (cell.width + kSheetGap) + 4, kSheetGap, columns[column], 2, kSheetInk);
    for (uint32_t row = 0; row < down; ++row) {
        showProgress("drawing cages", row + 1, down);
        const uint32_t top = kSheetGap + kSheetLabelHeight + row * step;
        sheet.drawText(kSheetGap + 4, top, cages[row].name, 2, kSheetFaintInk);
        const Status status = drawRow(session, cages[row], options, cell, view, top + kSheetLabelHeight, sheet);
        if (!status)
            return status.error();
    }
    if (legend)
        drawLegend(sheet, *legend);
    return host::writePng(sheet, options.output);
}

} // namespace

int runGallery(const GalleryOptions& options) {
    const Result<PictureKind> cells = parsePicture("--cell", options.cell, options.draw.view);
    if (!cells)
        return fail(kExitUsage, cells.error().message);
    if (chosenCages(options.only).empty())
        return fail(kExitUsage, "--only: no cage is called " + options.only);
    const OutputPath output[] = {{"--output", options.output}};
    if (const Status writable = canWrite(output); !writable)
        return fail(writable.error());
    const int code = withSession(deviceFlags(options.draw), [&](Session& session) {
        return drawGallery(session, options, cells->size, cells->view);
    });
    if (code == kExitOk)
        tellWritten(options.output);
    return code;
}

} // namespace supple::tools
