#include "cage/obj/reader.h"

#include "base/utf8_path.h"
#include "cage/leniency.h"
#include "cage/message.h"
#include "cage/obj/build.h"
#include "cage/obj/materials.h"
#include "cage/obj/parser.h"
#include "cage/refusal.h"
#include "cage/single_joint.h"

#include <exception>
#include <new>
#include <string_view>
#include <utility>
#include <vector>

namespace supple::cage {
namespace {

/// All of a character but what is done to every one at last, and its parts.
std::vector<PartCage> readInto(std::string_view text, const ObjOptions& options, Character& character) {
    const FileReader nothing = [](const std::string&) -> Result<std::vector<std::byte>> {
        return Error{ErrorCode::io, "external files are not allowed for an asset read from memory"};
    };
    Leniency leniency(options.finish.strict);
    Warnings skipped;
    const obj::File file = obj::parse(text, leniency, skipped);
    obj::readMaterials(file, options.readFile ? options.readFile : nothing, character);
    const std::vector<glm::vec3> colors = obj::giveWayToColors(file, character);
    std::vector<PartCage> parts = obj::buildParts(file, {options.weld, colors}, character.warnings);
    if (parts.empty()) {
        leniency.refuseAll({});
    }
    character.warnings.insert(character.warnings.end(), skipped.begin(), skipped.end());
    for (Damage& damage : leniency.takeDamages()) {
        character.damages.push_back(std::move(damage));
    }
    return parts;
}

} // namespace

Result<Character> readObj(std::span<const std::byte> bytes, const std::string& name, const ObjOptions& options) {
    const auto failure = [&](ErrorCode code, const std::string& message) {
        return Error{code, oneLine(name + ": " + message)};
    };
    try {
        Character character;
        character.name = name;
        std::vector<PartCage> parts =
            readInto({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, options, character);
        bindToOneJoint(parts, character, utf8Text(utf8Path(name).stem()));
        finishCharacter(std::move(parts), options.finish, character);
        return character;
    } catch (const Refusal& refusal) {
        return asError(refusal, name);
    } catch (const std::bad_alloc&) {
        return failure(ErrorCode::hostMemory, "file: out of memory");
    } catch (const std::exception& error) {
        return failure(ErrorCode::asset, std::string("file: ") + error.what());
    }
}

} // namespace supple::cage
