// Tables of fans (shaders/shared/chains.h): what chains of all vertices with one fan have in common. Private to
// chains/.
#pragma once

#include "surface/subdivision/pattern.h"
#include "surface/table_writer.h"

#include <map>

namespace supple::surface::chains {

inline constexpr uint32_t kFirstChainLevel = 2;

class FanTables {
public:
    /// Writes into `writer`, which must outlive this. `lastLevel`: of chains.
    FanTables(uint32_t lastLevel, TableWriter& writer) : lastLevel_(lastLevel), writer_(writer) {}

    struct Table {
        uint32_t element = 0;
        uint32_t netLists = 0; ///< element of those of sector 0; netListElements() each
    };
    /// Written when it is asked for first.
    [[nodiscard]] const Table& of(const subdivision::Fan& fan);
    [[nodiscard]] static uint32_t netListElements(Subdivision subdivision);

private:
    [[nodiscard]] Table write(const subdivision::Fan& fan);

    uint32_t lastLevel_;
    TableWriter& writer_;
    std::map<subdivision::Fan, Table> tables_;
};

} // namespace supple::surface::chains
