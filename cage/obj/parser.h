// Takes the text of an OBJ file apart. Private to cage/obj/.
#pragma once

#include "cage/leniency.h"
#include "cage/message.h"
#include "cage/obj/file.h"

#include <string>
#include <string_view>

namespace supple::cage::obj {

/// All indices of what comes out lie within the file. What was skipped is in `skipped`, one line for each kind: the
/// caller puts them behind its own. Throws Refusal.
[[nodiscard]] File parse(std::string_view text, Leniency& leniency, Warnings& skipped);

} // namespace supple::cage::obj
