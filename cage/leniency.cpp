#include "cage/leniency.h"

namespace supple::cage {
namespace {

/// A file of which more has to be left out is refused: it is none of those that somebody wants to use, and its faults
/// would take more time and memory than its elements.
constexpr size_t kMostLeftOut = 4096;
/// Nodes may share a mesh, and its faults are found once for each. So many repeated lines of 256 characters take
/// seconds.
constexpr uint64_t kMostRepeats = 1u << 20;
constexpr size_t kLineLength = 256;
/// If a file is refused because nothing of it is left, no more of its faults are told.
constexpr size_t kMostTold = 24;
/// readableLines() tells fewer.
constexpr size_t kMostKeptLines = 4096;

} // namespace

void Leniency::mend(const std::string& element, const std::string& reason, const std::string& mended) {
    if (strict_) {
        refuse(element, reason);
    }
    note(element + ": " + reason, mended);
}

void Leniency::leaveOut(const Refusal& refusal) {
    if (strict_ || refusal.code != ErrorCode::asset) {
        refusals_.keep(refusal);
        return;
    }
    bool isNew = false;
    for (const std::string& fault : refusal.faults) {
        isNew = note(fault, "left out") || isNew;
    }
    if (!isNew) {
        return;
    }
    if (leftOutCount_++ < kMostTold) {
        leftOut_.keep({refusal.code, {refusal.faults.front()}});
    }
    if (leftOutCount_ > kMostLeftOut) {
        leftOut_.keep({ErrorCode::asset, {"file: more than " + std::to_string(kMostLeftOut) + " faults"}});
        leftOut_.raise();
    }
}

void Leniency::refuseAll(const std::set<std::string>& reasons) {
    raise();
    for (const std::string& reason : reasons) {
        leftOut_.keep({ErrorCode::asset, {reason}});
    }
    leftOut_.raise();
    throw Refusal{ErrorCode::asset, {"file: nothing is left of it"}};
}

bool Leniency::note(const std::string& found, const std::string& repair) {
    const bool isNew = !said_.contains(found);
    if (isNew && damages_.size() < kMostKeptLines) {
        said_.insert(found);
        damages_.push_back({found, repair});
        return true;
    }
    // More lines are not kept. Whether they repeat each other is not known then, so they count as if they did.
    repeats_ += 1 + found.size() / kLineLength;
    if (repeats_ > kMostRepeats) {
        refuse("file", "nodes share meshes with too many faults", ErrorCode::limit);
    }
    return isNew;
}

} // namespace supple::cage
