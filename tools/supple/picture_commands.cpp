// The command lines of supple render, sheet and view. What they do stands in render.h, contact_sheet.h and view.h.
#include "tools/supple/animate.h"
#include "tools/supple/command.h"
#include "tools/supple/contact_sheet.h"
#include "tools/supple/gallery.h"
#include "tools/supple/options.h"
#include "tools/supple/output_files.h"
#include "tools/supple/render.h"
#include "tools/supple/view.h"
#include "tools/supple/view_keys.h"
#include "tools/supple/views.h"

#include <CLI/CLI.hpp>
#include <memory>

namespace supple::tools {
namespace {

std::string place(const std::string& text) {
    double x = 0.0;
    double y = 0.0;
    return parsePlace(text, x, y) ? "" : text + " is not X,Y, each 0 to 1";
}

std::string point(const std::string& text) {
    glm::vec3 value;
    return parsePoint(text, value) ? "" : text + " is not X,Y,Z, all finite";
}

std::vector<std::string> viewNames() {
    std::vector<std::string> names;
    for (const NamedView& view : kViews)
        names.emplace_back(view.name);
    return names;
}

void bindShown(CLI::App& command, DrawOptions& draw) {
    const HelpGroup heading(command, "What is shown");
    command.add_option("--part", draw.parts, "Draw these parts alone; once per part (supple inspect lists them)")
        ->type_name("NAME|INDEX")
        ->allow_extra_args(false);
    command.add_flag("--shared-samples", draw.sharedSamples,
                     "One mesh whose patches share the samples on their borders (catmull-clark, pm, prep); without "
                     "lines of patches");
    command.add_option("--view", draw.view, "What is shown")->check(CLI::IsMember(viewNames()))->capture_default_str();
    command.add_option("--joint", draw.joint, "With --view weights: how much this joint moves the surface")
        ->type_name("NAME|INDEX")
        ->capture_default_str();
    command.add_flag("--cage,!--no-cage", draw.cageOverlay, "Draw the cage's edges over the surface");
    command.add_flag("--springs", draw.soft.springs,
                     "Draw chains of joints that swing, and how far they stay from colliders");
    command.add_flag("--colliders", draw.soft.colliders, "Draw what springs and cloth do not enter");
    command.add_flag("--painted", draw.soft.painted, "Dot the vertices of the cage that jiggle or are cloth");
    command.add_flag("--ground,!--no-ground", draw.ground, "A floor that takes shadows (on unless --no-ground)");
    command.add_flag("--legend,!--no-legend", draw.legend,
                     "What the view's colors stand for, in the picture's corner (on unless --no-legend)");
    const HelpGroup camera(command, "Camera");
    command.add_option("--yaw", draw.yaw, "Degrees; 0 looks at the front")
        ->check(CLI::Range(-360.0, 360.0))
        ->capture_default_str();
    command.add_option("--pitch", draw.pitch, "Degrees; positive looks down")
        ->check(CLI::Range(-89.0, 89.0))
        ->capture_default_str();
}

void bindDraw(CLI::App& command, DrawOptions& draw, const std::vector<std::string>& extraSchemes = {"cage"}) {
    bindScheme(command, draw.scheme, draw.partSchemes, draw.rate, draw.skinning, draw.reading, extraSchemes);
    bindSharpEdges(command, draw.creases, draw.sharpThreshold);
    bindRules(command, draw.rules);
    bindUvMode(command, draw.uvMode);
    bindMorphs(command, draw.morphs);
    bindShown(command, draw);
    bindDevice(command, draw.device, draw.mapping, draw.validate);
    bindRecord(command, draw.record);
}

/// What pictures have that stand alone.
void bindLooks(CLI::App& command, DrawOptions& draw) {
    const HelpGroup heading(command, "What is shown");
    command.add_flag("--split", draw.split, "The cage on the left half, the surface on the right one");
    command.add_flag("--levels", draw.levels,
                     "Levels of detail, as the camera needs them, instead of --rate; --view levels has them anyway");
    command.add_option("--chord-error", draw.chordError, "With levels: pixels that edges may lie beside their curves")
        ->check(CLI::Range(0.01f, 100.0f))
        ->capture_default_str();
}

/// Closer, or a camera that stands somewhere, instead of one that frames the figure. After the options that it
/// excludes.
void bindCamera(CLI::App& command, RenderOptions& options) {
    const HelpGroup heading(command, "Camera");
    command.add_option("--zoom", options.zoom, "Closer than what fills the picture, so many times")
        ->check(CLI::Range(1.0, 100.0))
        ->capture_default_str();
    command.add_option("--at", options.at, "What --zoom keeps in the middle: fractions from the upper left corner")
        ->check(CLI::Validator(place, "X,Y"))
        ->capture_default_str();
    const CLI::Validator isPoint(point, "X,Y,Z");
    CLI::Option* const eye =
        command.add_option("--eye", options.eye, "Where the camera stands, in units of the file")->check(isPoint);
    CLI::Option* const lookAt =
        command.add_option("--look-at", options.lookAt, "What it looks at")->check(isPoint)->needs(eye);
    eye->needs(lookAt);
    command.add_option("--up", options.up, "What is up in the picture")
        ->check(isPoint)
        ->capture_default_str()
        ->needs(eye);
    command.add_option("--fov", options.fieldOfView, "Degrees from the lower to the upper edge of the picture")
        ->check(CLI::Range(0.01, 170.0))
        ->capture_default_str()
        ->needs(eye);
    for (const char* framing : {"--yaw", "--pitch", "--zoom", "--at"}) {
        eye->excludes(command.get_option(framing));
    }
}

/// After the options that it excludes.
void bindTrace(CLI::App& command, DrawOptions& draw) {
    const HelpGroup heading(command, "What is shown");
    CLI::Option* const trace =
        command.add_flag("--trace", draw.trace,
                         "Shadows and the darkness of corners by rays that meet the surface, instead of shadow maps; "
                         "the device needs ray queries. Materials with holes throw shadows as if they had none, "
                         "glass throws none");
    for (const char* other : {"--levels", "--split"})
        trace->excludes(command.get_option(other));
}

/// Behind bindDraw().
void bindAlpha(CLI::App& command, DrawOptions& draw) {
    const HelpGroup heading(command, "What is shown");
    CLI::Option* alpha = command.add_flag(
        "--alpha", draw.alpha, "Nothing behind the figure: its shadow on the floor is drawn, the backdrop is not");
    for (const char* other : {"--springs", "--colliders", "--painted"})
        alpha->excludes(command.get_option(other));
}

} // namespace

void bindAnimate(CLI::App& app, int& exitCode) {
    auto options = std::make_shared<AnimateOptions>();
    CLI::App* command = app.add_subcommand(
        "animate", "A clip, or how one goes over to another, as an animated picture, or one picture a frame");
    command->add_option("FILE", options->file, "glTF, GLB or OBJ")->required();
    command
        ->add_option("-o,--output", options->output,
                     "An animated WebP; or PNGs, with #### where the numbers of the frames go")
        ->required()
        ->type_name("OUT.webp|OUT_####.png");
    command->add_option("--clip", options->clip, "Clip by name or index; the first one without it")
        ->type_name("NAME|INDEX");
    bindSize(*command, "--size", options->size, "Of the pictures");
    command->add_option("--fps", options->fps, "Frames a second")->check(CLI::Range(1.0, 240.0))->capture_default_str();
    command->add_option("--seconds", options->seconds, "Instead of the clip's length (4 without a clip)")
        ->check(CLI::Range(0.001, 3600.0));
    command->add_option("--turn", options->turn, "Degrees that the camera goes round the figure from end to end")
        ->check(CLI::Range(-3600.0, 3600.0));
    command->add_option("--quality", options->quality, "Of a WebP; 100 keeps every bit")
        ->check(CLI::Range(0.0f, 100.0f))
        ->capture_default_str();
    bindDraw(*command, options->draw);
    bindAlpha(*command, options->draw);
    bindLooks(*command, options->draw);
    bindTransition(*command, options->draw.transition);
    bindSimulate(*command, options->draw.simulate);
    command->get_option("--simulate")->excludes(command->get_option("--transition"));
    command->callback([options, &exitCode] {
        checkOutputs(inputsOf(options->file, options->draw.reading.clipFiles), {{"--output", options->output}});
        exitCode = runAnimate(*options);
    });
}

void bindRender(CLI::App& app, int& exitCode) {
    auto options = std::make_shared<RenderOptions>();
    CLI::App* command = app.add_subcommand("render", "One picture of a character");
    command->footer("Examples:\n"
                    "  supple render hero.glb -o hero.png --clip walk --time 0.4\n"
                    "  supple render hero.glb -o knee.png --zoom 4 --at 0.5,0.7 --view highlights --cage\n"
                    "  supple render hero.glb -o schemes.png --scheme all --size 640x480");
    command->add_option("FILE", options->file, "glTF, GLB or OBJ")->required();
    command->add_option("-o,--output", options->output, "PNG to write")->required()->type_name("OUT.png");
    bindSize(*command, "--size", options->size, "Of the picture; with --scheme all of each");
    bindPose(*command, options->clip, options->time, "the rest pose: as the nodes of the file stand");
    bindDraw(*command, options->draw, {"cage", kAllSchemes});
    bindAlpha(*command, options->draw);
    bindLooks(*command, options->draw);
    bindTrace(*command, options->draw);
    bindCamera(*command, *options);
    bindSimulate(*command, options->draw.simulate);
    command->callback([options, &exitCode] {
        glm::vec3 eye, lookAt, up;
        if (parsePoint(options->eye, eye) && parsePoint(options->lookAt, lookAt) && parsePoint(options->up, up) &&
            glm::length(glm::cross(lookAt - eye, up)) == 0.0f) {
            throw CLI::ValidationError("--eye", "--look-at is the same point, or --up points along the line to it");
        }
        checkOutputs(inputsOf(options->file, options->draw.reading.clipFiles), {{"--output", options->output}});
        exitCode = runRender(*options);
    });
}

void bindSheet(CLI::App& app, int& exitCode) {
    auto options = std::make_shared<ContactSheetOptions>();
    CLI::App* command = app.add_subcommand(
        "sheet", "A sheet of pictures: a row a clip, a column a time, the deformed cage beside the surface");
    command->add_option("FILE", options->file, "glTF, GLB or OBJ")->required();
    command->add_option("-o,--output", options->output, "PNG to write")->required()->type_name("OUT.png");
    command->add_option("--only,--clip", options->clips, "Clips by name or index, with commas between; all without it")
        ->type_name("NAME|INDEX,..");
    command->add_option("--columns", options->columns, "Times a clip")
        ->check(CLI::Range(1u, 32u))
        ->capture_default_str();
    bindSize(*command, "--cell", options->cell, "Of one picture; a column holds two");
    command->add_flag("--labels,!--no-labels", options->labels, "Write clip and time (on unless --no-labels)");
    bindDraw(*command, options->draw, {});
    command->callback([options, &exitCode] {
        checkOutputs(inputsOf(options->file, options->draw.reading.clipFiles), {{"--output", options->output}});
        exitCode = runContactSheet(*options);
    });
}

void bindGallery(CLI::App& app, int& exitCode) {
    auto options = std::make_shared<GalleryOptions>();
    options->draw = {.rate = 16, .view = "highlights", .ground = false, .yaw = 25.0, .pitch = 25.0};
    CLI::App* command = app.add_subcommand(
        "gallery", "Cages round one vertex, elliptic and as saddles, under all schemes side by side");
    command->add_option("-o,--output", options->output, "PNG to write")->required()->type_name("OUT.png");
    bindSize(*command, "--cell", options->cell, "Of one picture");
    command->add_option("--only", options->only, "Cages whose names begin so: \"polar\", \"valence 3, saddle\"")
        ->type_name("NAME");
    command->add_option("--rate", options->draw.rate, "Segments along an edge of the cage")
        ->check(CLI::Range(1u, SUPPLE_MAX_RATE))
        ->capture_default_str();
    command->add_option("--view", options->draw.view, "What is shown")
        ->check(CLI::IsMember(viewNames()))
        ->capture_default_str();
    command->add_flag("--cage,!--no-cage", options->draw.cageOverlay, "Draw the cage's edges over the surface");
    bindDevice(*command, options->draw.device, options->draw.mapping, options->draw.validate);
    command->callback([options, &exitCode] { exitCode = runGallery(*options); });
}

void bindView(CLI::App& app, int& exitCode) {
    auto options = std::make_shared<ViewOptions>();
    CLI::App* command = app.add_subcommand("view", "Characters in a window, playing");
    command->add_option("FILE", options->files,
                        "glTF, GLB or OBJ; one is shown at a time. Without one, choose it in the window");
    command->add_option("--clip", options->clip, "Clip by name or index to begin with")->type_name("NAME|INDEX");
    bindSize(*command, "--size", options->size, "Of the window");
    CLI::Option* frames = command->add_option("--frames", options->frames, "Close after so many; 0 stays open");
    command->add_option("--screenshot", options->screenshot, "Write the last frame, window and all")
        ->needs(frames)
        ->type_name("OUT.png");
    command
        ->add_option("--look", options->look,
                     "auto: on a CPU device fast while something moves, then ever better; with --frames the studio's")
        ->check(CLI::IsMember({"auto", "fast", "studio"}))
        ->capture_default_str();
    bindDraw(*command, options->draw);
    bindLooks(*command, options->draw);
    std::string keys = "Keys:";
    for (const ViewKey& key : kViewKeys) {
        keys += std::string("\n  ") + key.keys + std::string(28 - std::string(key.keys).size(), ' ') + key.what;
    }
    command->footer(keys);
    command->callback([options, &exitCode] { exitCode = runView(*options); });
}

} // namespace supple::tools
