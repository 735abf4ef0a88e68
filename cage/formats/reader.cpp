#include "cage/formats/reader.h"

#include "cage/gltf/uri.h"
#include "cage/obj/reader.h"

#include <algorithm>
#include <cctype>
#include <string_view>

namespace supple::cage {
namespace {

bool startsAsGltf(std::string_view text) {
    if (text.starts_with("\xEF\xBB\xBF")) {
        text.remove_prefix(3);
    }
    const size_t begin = text.find_first_not_of(" \t\r\n");
    return text.starts_with("glTF") || (begin != std::string_view::npos && text[begin] == '{');
}

bool isNamedObj(std::string_view name) {
    constexpr std::string_view kExtension = ".obj";
    return name.size() >= kExtension.size() &&
           std::equal(kExtension.begin(), kExtension.end(), name.end() - static_cast<ptrdiff_t>(kExtension.size()),
                      [](char a, char b) { return a == std::tolower(static_cast<unsigned char>(b)); });
}

} // namespace

Result<Character> readCharacter(std::span<const std::byte> bytes, const std::string& name,
                                const std::string& baseDirectory, const GltfOptions& options) {
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    if (isNamedObj(name) && !startsAsGltf(text)) {
        if (!options.clipFiles.empty()) {
            return Error{ErrorCode::argument, name + ": " + options.clipFiles.front().name +
                                                  ": an OBJ file has no nodes that clips of other files could move"};
        }
        if (!options.variant.empty()) {
            return Error{ErrorCode::argument, name + ": an OBJ file has no material variants"};
        }
        const FileReader readFolder = [&](const std::string& path) { return gltf::readBelow(baseDirectory, path); };
        return readObj(bytes, name,
                       {.finish = {options.sewParts, options.normalCreases, options.strict},
                        .weld = options.weldObj,
                        .readFile = options.readFile ? options.readFile : readFolder});
    }
    return readGltf(bytes, name, baseDirectory, options);
}

} // namespace supple::cage
