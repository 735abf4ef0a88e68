// The frame loop of supple profile: records, submits and collects timings, as a host without a window would.
#pragma once

#include "tools/common/character_file.h"
#include "tools/supple/profile_stage.h"
#include "tools/supple/profile_summary.h"
#include "tools/supple/session.h"

#include <chrono>
#include <span>
#include <string>
#include <vector>

namespace supple::tools {

class ProfileRing;

/// Runs files under a scheme. Frame numbers are the context's, which others may go on with.
class Profiler {
public:
    Profiler(Session& session, const ProfileOptions& options);

    /// One file; in a view as many as there are.
    [[nodiscard]] Result<ProfileRun> run(std::span<const host::CharacterFile> files, const std::string& scheme);

private:
    [[nodiscard]] SuppleContext context() const { return session_.context->handle(); }
    [[nodiscard]] Status check(SuppleResult result, const char* call) { return session_.context->check(result, call); }
    [[nodiscard]] double now() const;
    void readClocks(ProfileRun& run) const;
    [[nodiscard]] Status frames(ProfileStage& stage, ProfileRun& run);
    [[nodiscard]] Status frame(ProfileRing& ring, uint32_t index, ProfileStage& stage, ProfileRun& run);
    /// Who holds what; and, if groups give memory back, how much of it goes.
    [[nodiscard]] Status findHolders(ProfileStage& stage, ProfileRun& run);
    /// Adds the timings of the newest finished frame to its sample, if it is one of this run's measured frames, and
    /// what the view drew in it.
    [[nodiscard]] Status collect(const ProfileStage& stage, ProfileRun& run);

    Session& session_;
    const ProfileOptions& options_;
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
    uint64_t frame_ = 0;
    uint64_t collected_ = 0; ///< whose timings came in last
    std::vector<SuppleTiming> timings_;
};

} // namespace supple::tools
