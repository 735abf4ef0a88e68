#include "tools/supple/profile_page.h"

#include "base/utf8_path.h"
#include "host/operating_system.h"
#include "tools/supple/render.h"
#include "tools/supple/text_file.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>

namespace supple::tools {
namespace {

/// One for each file and scheme that ran by itself.
Result<std::vector<HtmlReport::Picture>> picturesOf(Session& session, const ProfileOptions& options,
                                                    const std::vector<host::CharacterFile>& files,
                                                    std::span<const ProfileRun> runs) {
    std::vector<HtmlReport::Picture> pictures;
    const std::string path = utf8Text(std::filesystem::temp_directory_path() /
                                      ("supple_profile_" + std::to_string(host::processId()) + ".png"));
    for (const ProfileRun& run : runs) {
        const bool known = std::any_of(pictures.begin(), pictures.end(), [&](const HtmlReport::Picture& picture) {
            return picture.file == run.file && picture.scheme == run.scheme;
        });
        const bool alone = std::any_of(files.begin(), files.end(),
                                       [&](const host::CharacterFile& file) { return file.path == run.file; });
        if (known || !alone) {
            continue;
        }
        RenderOptions picture;
        picture.file = run.file;
        picture.output = path;
        picture.clip = options.clip;
        picture.size = "520x600";
        picture.draw.scheme = run.scheme.find('+') == std::string::npos ? run.scheme : "auto";
        picture.draw.reading = options.surface.reading;
        picture.draw.device = options.device.device;
        picture.draw.mapping = options.device.mapping;
        picture.draw.morphs = options.morphs;
        const Status drawn = renderPicture(session, picture);
        if (!drawn) {
            return drawn.error();
        }
        std::ifstream png(utf8Path(path), std::ios::binary);
        pictures.push_back({run.file, run.scheme, {std::istreambuf_iterator<char>(png), {}}});
        std::filesystem::remove(utf8Path(path));
    }
    return pictures;
}

} // namespace

Status writeProfilePage(Session& session, const ProfileOptions& options, const Machine& machine,
                        const std::vector<host::CharacterFile>& files, std::span<const ProfileRun> runs,
                        std::span<const RunChange> changes) {
    Result<std::vector<HtmlReport::Picture>> pictures = picturesOf(session, options, files, runs);
    if (!pictures) {
        return pictures.error();
    }
    HtmlReport report{machine, runs, changes, std::move(*pictures), {}, options.budgetMs, "supple"};
    for (const host::CharacterFile& file : files) {
        for (const std::string& warning : file.character.warnings) {
            report.warnings.push_back(file.path + ": " + warning);
        }
    }
    for (const std::string& argument : options.arguments) {
        report.command += " " + argument;
    }
    return writeTextFile(options.html, toHtml(report));
}

} // namespace supple::tools
