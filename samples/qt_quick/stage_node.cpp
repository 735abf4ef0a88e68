#include "stage_node.h"

#include <QSGRendererInterface>

#include <algorithm>
#include <cmath>

namespace qt_quick {

StageNode::StageNode(QQuickWindow& window, const Device& device, const QString& recording)
    : window_(window), gpu_{device.physical(), device.handle()},
      characters_(device, static_cast<uint32_t>(window.graphicsStateInfo().framesInFlight), recording), painter_(gpu_),
      frameOfSlot_(static_cast<size_t>(window.graphicsStateInfo().framesInFlight), 0) {
    QObject::connect(
        &window, &QQuickWindow::beforeRendering, &connection_, [this] { render(); }, Qt::DirectConnection);
}

StageNode::~StageNode() {
    // Qt deletes its nodes on the render thread, which alone submits; the last frames may still run.
    vkDeviceWaitIdle(gpu_.device);
    texture_.reset(); // Qt's view of the picture, before the picture
    retired_.collect(UINT64_MAX);
    if (picture_)
        picture_->destroy();
    painter_.destroy();
}

void StageNode::sync(const Settings& settings, const QRectF& rect, double pixelRatio) {
    const auto pixels = [pixelRatio](double size) {
        return static_cast<uint32_t>(std::max(std::lround(size * pixelRatio), 1l));
    };
    resize({pixels(rect.width()), pixels(rect.height())});
    setRect(rect);
    // Loading makes the GUI wait, which a game would do elsewhere.
    if (characters_.choose(settings))
        painter_.bind(characters_, retired_, frame_);
    settings_ = settings;
    changed_ = true;
    markDirty(DirtyMaterial);
}

void StageNode::resize(VkExtent2D extent) {
    if (picture_ && picture_->extent().width == extent.width && picture_->extent().height == extent.height)
        return;
    if (picture_)
        retired_.add(frame_, [old = *picture_]() mutable { old.destroy(); });
    picture_.emplace(gpu_, extent);
    // The layout is a promise: render() leaves the image so in every frame, and Qt moves it nowhere else.
    std::unique_ptr<QSGTexture> texture(QNativeInterface::QSGVulkanTexture::fromNative(
        picture_->image(), VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL, &window_,
        QSize(static_cast<int>(extent.width), static_cast<int>(extent.height))));
    setTexture(texture.get());
    texture_ = std::move(texture);
}

/// Qt has waited for the fence of the slot that it now records into. So the last frame of that slot is complete, and
/// with it all before it, because one queue ran them in order. A slot may come twice in a row: a frame that is only
/// grabbed is not presented.
void StageNode::countFrame() {
    uint64_t& last = frameOfSlot_[static_cast<size_t>(window_.graphicsStateInfo().currentFrameSlot)];
    completed_ = std::max(completed_, last);
    last = ++frame_;
    retired_.collect(completed_);
}

/// beforeRendering: Qt has begun the command buffer, and no render pass.
void StageNode::render() {
    countFrame();
    if (!changed_)
        return; // a button lights up, but nobody has moved: the picture is still there
    changed_ = false;
    window_.beginExternalCommands();
    auto* commands = *static_cast<VkCommandBuffer*>(
        window_.rendererInterface()->getResource(&window_, QSGRendererInterface::CommandListResource));
    characters_.record(commands, settings_, frame_, completed_);
    const VkExtent2D extent = picture_->extent();
    painter_.draw(commands, characters_, *picture_,
                  frameUniforms(settings_, extent.width, extent.height, characters_.feet()), retired_, frame_);
    window_.endExternalCommands();
}

} // namespace qt_quick
