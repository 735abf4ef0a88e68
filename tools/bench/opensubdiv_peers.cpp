#include "tools/bench/opensubdiv_peers.h"

#ifdef SUPPLE_HAS_OPENSUBDIV
#include "tools/bench/opensubdiv_cpu_peer.h"

#include <opensubdiv/version.h>
#endif
#ifdef SUPPLE_HAS_OPENSUBDIV_GLSL
#include "tools/bench/opensubdiv_glsl_peer.h"
#endif

namespace supple::bench {

struct OpensubdivPeers::Inside {
    std::string cpu = "not built in: OpenSubdiv was not found", glsl = cpu;
    bool hasCpu = false, hasGlsl = false;
#ifdef SUPPLE_HAS_OPENSUBDIV_GLSL
    std::unique_ptr<GlContext> gl;
#endif
};

std::string peerName(PeerRules rules) {
    return rules == PeerRules::loop ? "OpenSubdiv Loop" : "OpenSubdiv";
}

OpensubdivPeers::OpensubdivPeers() : inside_(std::make_unique<Inside>()) {
#ifdef SUPPLE_HAS_OPENSUBDIV
    constexpr int kVersion = OPENSUBDIV_VERSION_NUMBER;
    inside_->hasCpu = true;
    inside_->cpu = std::to_string(kVersion / 10000) + "." + std::to_string(kVersion / 100 % 100) + "." +
                   std::to_string(kVersion % 100);
    inside_->glsl = "not built in: OpenSubdiv's GPU library or EGL was not found";
#endif
#ifdef SUPPLE_HAS_OPENSUBDIV_GLSL
    Result<std::unique_ptr<GlContext>> gl = GlContext::create();
    inside_->hasGlsl = static_cast<bool>(gl);
    inside_->glsl = gl ? (*gl)->name() : gl.error().message;
    if (gl) {
        inside_->gl = std::move(*gl);
    }
#endif
}

OpensubdivPeers::~OpensubdivPeers() = default;

std::string OpensubdivPeers::cpu() const {
    return inside_->cpu;
}

std::string OpensubdivPeers::glsl() const {
    return inside_->glsl;
}

bool OpensubdivPeers::hasCpu() const {
    return inside_->hasCpu;
}

bool OpensubdivPeers::hasGlsl() const {
    return inside_->hasGlsl;
}

Result<std::vector<Peer>> OpensubdivPeers::make([[maybe_unused]] const cage::Cage& cage,
                                                [[maybe_unused]] PeerRules rules,
                                                [[maybe_unused]] uint32_t rate) const {
    std::vector<Peer> peers;
#ifdef SUPPLE_HAS_OPENSUBDIV
    Result<std::unique_ptr<OpensubdivTables>> made = opensubdivTables(cage, rules, rate);
    if (!made) {
        return made.error();
    }
    const std::shared_ptr<const OpensubdivTables> tables = std::move(*made);
    peers = opensubdivCpuPeers(tables);
#endif
#ifdef SUPPLE_HAS_OPENSUBDIV_GLSL
    if (inside_->gl != nullptr) {
        Result<std::vector<Peer>> glsl = opensubdivGlslPeers(*inside_->gl, tables);
        if (!glsl) {
            return glsl.error();
        }
        peers.insert(peers.end(), glsl->begin(), glsl->end());
    }
#endif
    return peers;
}

} // namespace supple::bench
