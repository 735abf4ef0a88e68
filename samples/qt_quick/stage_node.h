// The stage in Qt's scene graph: a rectangle with a texture. All of it lives on Qt's render thread.
//
// Why a texture, and not draws into Qt's own pass? Qt has three places for a host's commands. In its render pass, under
// all items (beforeRenderPassRecording) or between them (QSGRenderNode), the depth buffer is the scene graph's: it
// sorts its opaque items with it, so a character's depths would hide them. The pass has the window's format and samples
// besides, and nobody may dispatch or place a barrier in it. Before the pass (beforeRendering) all is the host's own:
// an image with depth and four samples, dynamic rendering, Supple's compute passes. And what comes out is an item like
// any other, which QML can place, clip, fade and put under effects. It costs one image and one copy.
#pragma once

#include "painter.h"

#include <QObject>
#include <QSGSimpleTextureNode>
#include <QSGTexture>

#include <memory>
#include <optional>

namespace qt_quick {

class StageNode : public QSGSimpleTextureNode {
public:
    StageNode(QQuickWindow& window, const Device& device, const QString& recording);
    ~StageNode() override;

    /// From updatePaintNode, while the GUI thread waits.
    void sync(const Settings& settings, const QRectF& rect, double pixelRatio);
    void report(Report& out) const { characters_.report(out); }

private:
    void render();
    void countFrame();
    void resize(VkExtent2D extent);

    QQuickWindow& window_;
    Gpu gpu_;
    Characters characters_;
    Painter painter_;
    Retired retired_;
    std::optional<Picture> picture_;
    std::unique_ptr<QSGTexture> texture_; ///< Qt's view of the picture; what it owns outlives the frames in flight
    Settings settings_;
    bool changed_ = false;
    uint64_t frame_ = 0;                ///< every frame of Qt's has a number, drawn or not
    uint64_t completed_ = 0;            ///< the last frame that the device has finished
    std::vector<uint64_t> frameOfSlot_; ///< the last one that was recorded in each of Qt's slots
    QObject connection_;                ///< goes with the node, and so does the connection
};

} // namespace qt_quick
