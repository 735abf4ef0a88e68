// Groups that read the coefficients of the group whose instances they draw: each has a place, in which its view notes
// what it sees (shaders/shared/bounds.h).
#pragma once

#include "shaders/shared/bounds.h"

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <utility>

namespace supple::runtime {

/// The places that a followed group has for those who read its coefficients.
class Sharers {
public:
    /// A place that nobody has; nothing: all are taken.
    [[nodiscard]] std::optional<uint32_t> take() {
        for (uint32_t place = 0; place < taken_.size(); ++place) {
            if (!std::exchange(taken_[place], true)) {
                return place;
            }
        }
        return std::nullopt;
    }
    void give(uint32_t place) { taken_[place] = false; }
    /// One past the last place that is taken.
    [[nodiscard]] uint32_t end() const {
        uint32_t end = 0;
        for (uint32_t place = 0; place < taken_.size(); ++place) {
            end = taken_[place] ? place + 1 : end;
        }
        return end;
    }

private:
    std::array<bool, shared::kMaxSharers> taken_{};
};

/// One of these places, taken as long as this lives. The group that is followed may go before.
class SharerPlace {
public:
    SharerPlace() = default;
    explicit SharerPlace(std::shared_ptr<Sharers> sharers) : sharers_(std::move(sharers)) {
        place_ = sharers_ != nullptr ? sharers_->take() : std::nullopt;
    }
    SharerPlace(SharerPlace&& other) noexcept
        : sharers_(std::move(other.sharers_)), place_(std::exchange(other.place_, std::nullopt)) {}
    SharerPlace& operator=(SharerPlace&& other) noexcept {
        std::swap(sharers_, other.sharers_);
        std::swap(place_, other.place_);
        return *this;
    }
    ~SharerPlace() {
        if (place_) {
            sharers_->give(*place_);
        }
    }
    [[nodiscard]] const std::optional<uint32_t>& number() const { return place_; }

private:
    std::shared_ptr<Sharers> sharers_;
    std::optional<uint32_t> place_;
};

} // namespace supple::runtime
