#include "skinning/driver_table.h"

#include "cage/solved_driver.h"
#include "shaders/shared/pose.h"
#include "skinning/bits.h"
#include "skinning/rotation.h"

#include <algorithm>
#include <array>
#include <map>

namespace supple::skinning {
namespace {

using namespace shared;

static_assert(static_cast<uint32_t>(cage::TurnPart::rotation) == kTurnWhole &&
              static_cast<uint32_t>(cage::TurnPart::swing) == kTurnSwing &&
              static_cast<uint32_t>(cage::TurnPart::twist) == kTurnTwist);
static_assert(cage::kMaxDriverInputs == kMaxDriverInputs);

class DriverBuilder {
public:
    DriverBuilder(const cage::Character& character, std::span<const uint32_t> places, uint32_t firstElement)
        : character_(character), places_(places), first_(firstElement) {}

    DriverTable build() && {
        solve();
        std::map<uint32_t, std::vector<size_t>> quads; // the drivers of each, in their order
        for (size_t d = 0; d < character_.drivers.size(); ++d) {
            if (placed_[d].solved.samples.empty()) {
                continue;
            }
            for (const uint32_t target : character_.drivers[d].targets) {
                std::vector<size_t>& own = quads[target / 4];
                if (own.empty() || own.back() != d) {
                    own.push_back(d);
                }
            }
        }
        if (quads.empty()) {
            return {};
        }
        table_.quads = static_cast<uint32_t>(quads.size());
        size_t shares = 0;
        for (const auto& [quad, drivers] : quads) {
            shares += drivers.size();
        }
        // The head, quads and shares stand before what drivers have, whose places they name.
        const size_t sharesBegin = 1 + quads.size();
        table_.words.assign(4 * (sharesBegin + kShareElements * shares), 0u);
        table_.words[0] = table_.quads;
        for (size_t d = 0; d < character_.drivers.size(); ++d) {
            if (!placed_[d].solved.samples.empty()) {
                putDriver(character_.drivers[d], placed_[d]);
            }
        }
        size_t element = 1, share = sharesBegin;
        for (const auto& [quad, drivers] : quads) {
            const size_t end = share + kShareElements * drivers.size();
            set(element++, {quad, at(share), at(end), 0u});
            for (const size_t d : drivers) {
                setShare(share, quad, d);
                share += kShareElements;
            }
        }
        return std::move(table_);
    }

private:
    /// What stands in the table of a driver once, whatever quads it sets.
    struct Placed {
        cage::SolvedDriver solved;
        uint32_t inputs = 0, rotations = 0;
        std::map<uint32_t, uint32_t> coefficients; ///< by quad
    };

    [[nodiscard]] uint32_t at(size_t element) const { return first_ + static_cast<uint32_t>(element); }
    [[nodiscard]] uint32_t next() const { return at(table_.words.size() / 4); }
    void put(const std::array<uint32_t, 4>& element) {
        table_.words.insert(table_.words.end(), element.begin(), element.end());
    }
    void putFloats(const glm::vec4& v) { put({bits(v.x), bits(v.y), bits(v.z), bits(v.w)}); }
    void set(size_t element, const std::array<uint32_t, 4>& words) {
        std::copy(words.begin(), words.end(), table_.words.begin() + static_cast<ptrdiff_t>(4 * element));
    }
    void setFloats(size_t element, const glm::vec4& v) { set(element, {bits(v.x), bits(v.y), bits(v.z), bits(v.w)}); }

    uint32_t numberOf(uint32_t node) {
        const auto [found, isNew] = numbers_.try_emplace(node, static_cast<uint32_t>(table_.nodes.size()));
        if (isNew) {
            table_.nodes.push_back(node);
        }
        return found->second;
    }

    /// Drivers without a solution, of a character that no reader has let through, have no samples and set nothing.
    void solve() {
        for (const cage::PoseDriver& driver : character_.drivers) {
            Placed& placed = placed_.emplace_back();
            if (Result<cage::SolvedDriver> solved = cage::solveDriver(driver)) {
                placed.solved = std::move(*solved);
            }
        }
    }

    void putDriver(const cage::PoseDriver& driver, Placed& placed) {
        placed.inputs = next();
        for (const cage::DriverInput& input : driver.inputs) {
            const glm::dquat rest = unit(glm::dquat(character_.skeleton.nodes[input.node].rotation));
            const uint32_t place = places_.empty() ? 0 : places_[input.node];
            put({place, numberOf(input.node), static_cast<uint32_t>(input.part), bits(input.weight)});
            putFloats(glm::vec4(glm::dvec4(-rest.x, -rest.y, -rest.z, rest.w)));
            putFloats(glm::vec4(input.axis, 0.0f));
        }
        placed.rotations = next();
        for (const glm::vec4& sample : placed.solved.samples) {
            putFloats(sample);
        }
        putCoefficients(driver, placed);
    }

    void putCoefficients(const cage::PoseDriver& driver, Placed& placed) {
        const size_t targets = driver.targets.size();
        for (const uint32_t target : driver.targets) {
            if (!placed.coefficients.try_emplace(target / 4, next()).second) {
                continue;
            }
            for (size_t pose = 0; pose * targets < placed.solved.coefficients.size(); ++pose) {
                glm::vec4 four(0.0f);
                for (size_t t = 0; t < targets; ++t) {
                    if (driver.targets[t] / 4 == target / 4) {
                        four[static_cast<int>(driver.targets[t] % 4)] = placed.solved.coefficients[pose * targets + t];
                    }
                }
                putFloats(four);
            }
        }
    }

    void setShare(size_t element, uint32_t quad, size_t d) {
        const cage::PoseDriver& driver = character_.drivers[d];
        const Placed& placed = placed_[d];
        const auto inputs = static_cast<uint32_t>(driver.inputs.size());
        const auto poses = static_cast<uint32_t>(placed.solved.samples.size() / driver.inputs.size());
        glm::vec4 low(0.0f), high(0.0f);
        for (const uint32_t target : driver.targets) {
            if (target / 4 == quad) {
                low[static_cast<int>(target % 4)] = driver.low;
                high[static_cast<int>(target % 4)] = driver.high;
            }
        }
        set(element, {inputs, placed.inputs, poses, placed.rotations});
        setFloats(element + 1, low);
        setFloats(element + 2, high);
        set(element + 3, {placed.coefficients.at(quad), bits(placed.solved.inverseSigma2), 0u, 0u});
    }

    const cage::Character& character_;
    std::span<const uint32_t> places_;
    uint32_t first_;
    DriverTable table_;
    std::vector<Placed> placed_; ///< by driver
    std::map<uint32_t, uint32_t> numbers_;
};

} // namespace

DriverTable buildDriverTable(const cage::Character& character, std::span<const uint32_t> places,
                             uint32_t firstElement) {
    return DriverBuilder(character, places, firstElement).build();
}

void putDrivers(const cage::Character& character, ClipTable& table) {
    const auto first = static_cast<uint32_t>(table.words.size() / 4);
    DriverTable own = buildDriverTable(character, table.places, first);
    if (own.quads == 0) {
        return;
    }
    table.drivers = first;
    table.drivenQuads = own.quads;
    table.driverNodes = std::move(own.nodes);
    table.words.insert(table.words.end(), own.words.begin(), own.words.end());
}

} // namespace supple::skinning
