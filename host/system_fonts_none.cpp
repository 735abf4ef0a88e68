#include "host/system_fonts.h"

namespace supple::host {

std::vector<FontFile> systemFonts(const std::u32string& /*characters*/) {
    return {};
}

} // namespace supple::host
