// Makes the page of supple profile --html: draws what was measured, and writes the file.
#pragma once

#include "tools/supple/profile_html.h"
#include "tools/supple/profile_stage.h"
#include "tools/supple/session.h"

#include <span>
#include <vector>

namespace supple::tools {

[[nodiscard]] Status writeProfilePage(Session& session, const ProfileOptions& options, const Machine& machine,
                                      const std::vector<host::CharacterFile>& files, std::span<const ProfileRun> runs,
                                      std::span<const RunChange> changes);

} // namespace supple::tools
