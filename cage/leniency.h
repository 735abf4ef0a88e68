// What becomes of the faults of a file. A lenient reading mends what it can, leaves out the least that is broken, says
// so in one warning for each, and goes on. A strict reading refuses the file and tells all of its faults at once.
//
// Readers hand their faults to a Leniency and need not ask which of the two it is. What a reading cannot go on with,
// and whatever would give a wrong shape without a word, is refused by both: gather(), or a Refusal that nobody catches.
#pragma once

#include "cage/character.h"
#include "cage/message.h"
#include "cage/refusal.h"

#include <cstddef>
#include <cstdint>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace supple::cage {

class Leniency {
public:
    explicit Leniency(bool strict) : strict_(strict) {}

    /// A fault that the caller mends as `mended` says. A strict reading does not come back from here: throws Refusal.
    void mend(const std::string& element, const std::string& reason, const std::string& mended);

    /// Calls read(), and tells whether it refused nothing. If it did refuse, the caller leaves out what was read, and
    /// goes on. What was left out of a strict reading is refused by raise(). An exceeded limit is thrown on.
    template <class Read>
    bool leaveOut(Read&& read) {
        try {
            read();
            return true;
        } catch (const Refusal& refusal) {
            leaveOut(refusal);
            return false;
        }
    }
    void leaveOut(const Refusal& refusal);

    /// Calls read() for what cannot be left out: what it refuses is kept for raise().
    template <class Read>
    bool gather(Read&& read) {
        return refusals_.gather(read);
    }
    /// Throws what has to be refused so far, if there is anything.
    void raise() const { refusals_.raise(); }
    [[nodiscard]] bool mustRefuse() const { return !refusals_.none(); }

    /// Nothing of the file is left: throws all that was left out, and `reasons`.
    [[noreturn]] void refuseAll(const std::set<std::string>& reasons);

    /// What was mended or left out. Equal lines are there once: nodes may share a mesh.
    [[nodiscard]] std::vector<Damage> takeDamages() { return std::move(damages_); }

private:
    /// Returns whether the line is new.
    bool note(const std::string& found, const std::string& repair);

    bool strict_;
    Refusals refusals_;       ///< what has to be refused
    Refusals leftOut_;        ///< the first of what was left out
    size_t leftOutCount_ = 0; ///< without repeated lines
    uint64_t repeats_ = 0;    ///< of lines, long ones more than once
    std::vector<Damage> damages_;
    std::set<std::string> said_;
};

} // namespace supple::cage
