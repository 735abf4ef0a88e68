// Entries of a list that make no sense: left out with one warning.
#pragma once

#include "cage/leniency.h"
#include "cage/message.h"

#include <cstddef>
#include <string>
#include <utility>

namespace supple::cage {

/// The faults of a list's entries: the first by name, the others counted, so that no file can fill the log.
class EntryFaults {
public:
    explicit EntryFaults(std::string list) : list_(std::move(list)) {}

    void add(size_t entry, const std::string& reason) {
        if (count_++ == 0) {
            first_ = item(list_, entry);
            reason_ = reason;
        }
    }
    void report(Warnings& warnings) const {
        if (count_ > 0) {
            warn(warnings, first_, reason_ + "; " + mended("left out"));
        }
    }
    /// As faults of the file, mended so.
    void report(Leniency& leniency, const std::string& how) const {
        if (count_ > 0) {
            leniency.mend(first_, reason_, mended(how));
        }
    }

private:
    [[nodiscard]] std::string mended(const std::string& how) const {
        return how + (count_ > 1 ? ", as are " + std::to_string(count_ - 1) + " more" : "");
    }

    std::string list_;
    std::string first_;
    std::string reason_;
    size_t count_ = 0;
};

} // namespace supple::cage
