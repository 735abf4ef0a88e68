#include "tools/common/part_settings.h"

#include "tools/common/character_file.h"
#include "tools/common/schemes.h"

#include <algorithm>

namespace supple::host {

std::vector<std::string> partNames(const cage::Character& character) {
    std::vector<std::string> names;
    for (const cage::Part& part : character.parts)
        names.push_back(part.name);
    return names;
}

Result<std::vector<bool>> findParts(const std::string& owner, const std::vector<std::string>& names,
                                    const std::vector<std::string>& texts) {
    std::vector<bool> found(names.size(), texts.empty());
    for (const std::string& text : texts) {
        const bool isName = std::find(names.begin(), names.end(), text) != names.end();
        for (size_t p = 0; p < names.size() && isName; ++p)
            found[p] = found[p] || names[p] == text;
        if (isName)
            continue;
        const Result<uint32_t> part = findNamed(owner, "part", names, text);
        if (!part)
            return part.error();
        found[*part] = true;
    }
    return found;
}

Result<PartScheme> parsePartScheme(const std::string& text) {
    const size_t cut = text.rfind('=');
    if (cut == std::string::npos || cut == 0)
        return Error{ErrorCode::argument, text + " is not PART=SCHEME"};
    const std::string name = text.substr(cut + 1);
    const SuppleScheme scheme = tools::schemeOf(name);
    if (scheme == SUPPLE_SCHEME_CAGE || (scheme == SUPPLE_SCHEME_AUTO && name != "auto"))
        return Error{ErrorCode::argument,
                     name + " is no scheme of a part" + (name == "exact" ? "; it is called catmull-clark now" : "")};
    return PartScheme{text.substr(0, cut), scheme};
}

Result<std::vector<SuppleScheme>> partSchemes(const std::string& owner, const std::vector<std::string>& names,
                                              const std::vector<PartScheme>& settings) {
    std::vector<SuppleScheme> schemes(settings.empty() ? 0 : names.size(), SUPPLE_SCHEME_AUTO);
    for (const PartScheme& setting : settings) {
        const Result<std::vector<bool>> parts = findParts(owner, names, {setting.part});
        if (!parts)
            return parts.error();
        for (size_t p = 0; p < names.size(); ++p)
            schemes[p] = (*parts)[p] ? setting.scheme : schemes[p];
    }
    return schemes;
}

} // namespace supple::host
