// Follows the tables of shaders/shared/subdivision.h as the kernels of shaders/subdivision do.
#include "shaders/shared/subdivision.h"
#include "surface/build.h"
#include "surface/fragments/class_check.h"
#include "surface/grid.h"
#include "surface/stencil_table.h"
#include "surface/table_check_common.h"

#include <array>
#include <span>
#include <vector>

namespace supple::surface::fragments {

using namespace subdivision;

namespace {

using namespace shared;

constexpr uint32_t kBlockElements = 3;

/// Blocks of one class, step and kind of work. All say the same but which lanes they are.
class BlockCheck {
public:
    /// `step`: the level that is written; one behind the last is the limit.
    BlockCheck(TableCheck& check, ClassCheck& own, uint32_t step, uint32_t kind)
        : check_(check), own_(own), step_(step), isLimit_(step > check.tables().fragments.steps),
          inBulk_(kind == kInBulk) {}

    bool run(const Section& section) {
        if (section.count == 0) {
            return true;
        }
        const std::span<const uint32_t> first = at(section.table);
        rows_ = first[0];
        list_ = first[1];
        places_ = first[7];
        const uint64_t lanes = uint64_t{places_} * own_.fragments();
        if (!check_.require(section.count == (lanes + kBlockLanes - 1) / kBlockLanes, "another number than of lanes")) {
            return false;
        }
        for (uint64_t b = 0; b < section.count; ++b) {
            if (!checkBlock(at(section.table + kBlockElements * b), b * kBlockLanes)) {
                return false;
            }
        }
        return followWork();
    }

private:
    [[nodiscard]] std::span<const uint32_t> at(uint64_t element) const {
        return std::span(check_.tables().words).subspan(4 * element, size_t{4} * kBlockElements);
    }

    bool checkBlock(std::span<const uint32_t> block, uint64_t lane) {
        const uint32_t fragments = own_.fragments();
        const bool hasList = isLimit_ || !inBulk_;
        return check_.require(block[0] == rows_ && block[7] == places_ && (!hasList || block[1] == list_),
                              "of other work than the first one") &&
               check_.require(block[2] == lane / fragments && block[3] == lane % fragments, "lanes out of order") &&
               check_.require(block[6] == fragments && (inBulk_ || block[9] == own_.header()), "of another class") &&
               check_.require(block[4] == (step_ == 1 ? own_.net() : own_.level(step_ - 1).run) &&
                                  (isLimit_ ||
                                   (block[5] == own_.level(step_).run && block[8] == own_.level(step_ - 1).neighbours)),
                              "of another step");
    }

    bool followWork() {
        const Section work{rows_, places_};
        if (isLimit_) {
            return check_.require(list_ == own_.patches(), "other patches than the class's") &&
                   (inBulk_ ? own_.followStrips(work)
                            : check_.require(rows_ == own_.limitRows().table && places_ <= own_.limitRows().count,
                                             "other limit rows than the class's"));
        }
        return inBulk_ ? own_.followCells(work, step_)
                       : check_.require(rows_ == own_.level(step_).rows, "other rows than the step's") &&
                             own_.followList(list_, places_, step_);
    }

    TableCheck& check_;
    ClassCheck& own_;
    uint32_t step_;
    bool isLimit_, inBulk_;
    uint32_t rows_ = 0, list_ = 0, places_ = 0;
};

class FragmentCheck {
public:
    explicit FragmentCheck(TableCheck& check)
        : check_(check), tables_(check.tables()), all_(tables_.fragments), followed_(check), runs_(check) {}

    void run() { (void)(checkMembers() && checkSteps() && checkAllClasses() && checkUvs()); }

private:
    bool checkMembers() {
        const bool loop = check_.source().recipe.scheme == SchemeId::loopFragments;
        check_.begin("fragments");
        return check_.require(all_.loop == loop, "of another subdivision") &&
               check_.require(all_.steps < 32 && tables_.rate == 1u << all_.steps, "steps of another rate") &&
               checkClasses(check_, {loop ? PatchClass::loop : PatchClass::fragment});
    }

    /// The steps before the isolated level, by stencils.
    bool checkSteps() {
        const std::array ofCage = {stencilKernel(false, kHalfWords), stencilKernel(false, kWholeWords)};
        const std::array inPool = {stencilKernel(true, kHalfWords), stencilKernel(true, kWholeWords)};
        const auto& steps = tables_.constructions;
        if (!checkKernels(check_, {{Stage::vertex, ofCage}, {Stage::assemble, inPool}}) ||
            !check_.require(!steps.empty() && steps.size() == tables_.isolationSteps &&
                                steps.front().stage == Stage::vertex && steps.back().to == 0 &&
                                (steps.size() == 1 || steps.back().stage == Stage::assemble),
                            "other steps than of isolation")) {
            return false;
        }
        check_.begin("stencils");
        uint64_t vertices = check_.source().vertices;
        for (const Construction& step : steps) {
            if (!check_.pool(step.to, step.coefficients) || !checkStencils(check_, step, vertices)) {
                return false;
            }
            vertices = uint64_t{step.to} + step.coefficients;
        }
        return true;
    }

    bool checkAllClasses() {
        check_.begin("fragments");
        const size_t sections = (size_t{all_.steps} + 1) * kWorkKinds;
        uint64_t next = all_.classes.front().fragments.table;
        nextBlocks_.resize(sections);
        for (const Fragments::Class& own : all_.classes) {
            const Section& records = own.fragments;
            check_.begin("fragments");
            if (!check_.require(records.table == next && records.count > 0, "classes do not follow each other") ||
                !check_.elements(records.table, records.count) ||
                !check_.require(own.blocks.size() == sections, "another number of kinds of work") || !checkClass(own)) {
                return false;
            }
            next += records.count;
        }
        check_.begin("fragments");
        return check_.require(all_.scratchStride == (runs_.end() + 15) / 16 * 16, "another size of the scratch buffer");
    }

    bool checkClass(const Fragments::Class& own) {
        const uint32_t header = check_.element(own.fragments.table)[0];
        ClassCheck ownClass(check_, followed_, header);
        if (!ownClass.run(runs_)) {
            return false;
        }
        check_.begin("fragments");
        if (!check_.require(ownClass.fragments() == own.fragments.count, "another number than in the header") ||
            !check_.require(ownClass.sharedPoints() == own.sharedPoints, "other points than in the header")) {
            return false;
        }
        for (uint64_t f = 0; f < own.fragments.count; ++f) {
            const std::span<const uint32_t> record = check_.element(own.fragments.table + f);
            if (!check_.require(record[0] == header, "of another class") ||
                !check_.within(record[1], 1, own.fragments.count, "fragments")) {
                return false;
            }
        }
        return checkBlocks(own, ownClass);
    }

    /// Blocks of the same step and kind follow each other from class to class.
    bool checkBlocks(const Fragments::Class& own, ClassCheck& ownClass) {
        const bool isFirst = &own == &all_.classes.front();
        for (size_t s = 0; s < own.blocks.size(); ++s) {
            const Section& section = own.blocks[s];
            const uint64_t elements = uint64_t{kBlockElements} * section.count;
            check_.begin("blocks");
            nextBlocks_[s] = isFirst ? section.table : nextBlocks_[s];
            if (!check_.require(section.table == nextBlocks_[s], "they do not follow each other") ||
                !check_.elements(section.table, elements)) {
                return false;
            }
            nextBlocks_[s] += elements;
            const auto step = static_cast<uint32_t>(s / kWorkKinds) + 1, kind = static_cast<uint32_t>(s % kWorkKinds);
            if (!BlockCheck(check_, ownClass, step, kind).run(section)) {
                return false;
            }
        }
        return true;
    }

    /// The samples of a rate themselves.
    bool checkUvs() {
        check_.begin("smooth texture coordinates");
        const uint64_t samples = sampleCount(all_.loop ? Domain::triangle : Domain::quad, tables_.rate);
        return tables_.uvMode == cage::UvMode::all ||
               check_.elements(tables_.ranges.front().smoothUvs, samples * tables_.uvSets * tables_.patches.size());
    }

    TableCheck& check_;
    const Tables& tables_;
    const Fragments& all_;
    Followed followed_;
    ScratchRuns runs_;
    std::vector<uint64_t> nextBlocks_; ///< by step and kind: where the next class's begin
};

} // namespace

void check(TableCheck& check) {
    FragmentCheck(check).run();
}

} // namespace supple::surface::fragments
