// Which evaluators of OpenSubdiv there are to compare with, whether or not it is installed.
#pragma once

#include "cage/character.h"
#include "tools/bench/peer.h"

#include <memory>
#include <string>
#include <vector>

namespace supple::bench {

/// Peers are refused more points than this: the tables of their limit stencils take a gigabyte.
inline constexpr size_t kMostPeerPoints = 1'500'000;

/// The library and the rules, as its peers are called.
[[nodiscard]] std::string peerName(PeerRules rules);

class OpensubdivPeers {
public:
    OpensubdivPeers();
    ~OpensubdivPeers();
    OpensubdivPeers(const OpensubdivPeers&) = delete;
    OpensubdivPeers& operator=(const OpensubdivPeers&) = delete;

    /// The library's version, or why there are no such peers.
    [[nodiscard]] std::string cpu() const;
    /// What its GLSL runs on, or why there are no such peers.
    [[nodiscard]] std::string glsl() const;
    [[nodiscard]] bool hasCpu() const;
    [[nodiscard]] bool hasGlsl() const;

    /// Empty where there are none; else limit stencils on the CPU first. They end before this does. ErrorCode::limit:
    /// beyond kMostPeerPoints; ErrorCode::asset: OpenSubdiv refuses the cage.
    [[nodiscard]] Result<std::vector<Peer>> make(const cage::Cage& cage, PeerRules rules, uint32_t rate) const;

private:
    struct Inside;
    std::unique_ptr<Inside> inside_;
};

} // namespace supple::bench
