#include "tools/supple/view.h"

#include "tools/supple/command.h"

namespace supple::tools {

int runView(const ViewOptions&) { return fail(kExitUsage, "not built"); }

} // namespace supple::tools
