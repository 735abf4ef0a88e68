#include "stage.h"

#include "stage_node.h"

#include <QFileInfo>

#include <algorithm>

namespace qt_quick {

Stage::Stage() {
    setFlag(ItemHasContents);
    connect(this, &Stage::changed, this, &QQuickItem::update);
}

void Stage::open(const Device& device, const QStringList& files, const QString& recording) {
    device_ = &device;
    settings_.files = files;
    settings_.recording = recording;
    emit opened();
}

QStringList Stage::characters() const {
    QStringList names;
    for (const QString& file : settings_.files)
        names += QFileInfo(file).completeBaseName();
    return names;
}

QVariantList Stage::passes() const {
    QVariantList out;
    for (const Report::Pass& pass : report_.passes)
        out += QVariantMap{{"name", pass.name}, {"milliseconds", pass.milliseconds}};
    return out;
}

void Stage::setCharacter(int character) {
    if (character < 0 || character >= settings_.files.size() || character == settings_.character)
        return;
    settings_.character = character;
    clip_ = 0;
    emit changed();
}

void Stage::advance(double seconds) {
    if (speed_ <= 0.0)
        return; // nothing moves: Qt need not draw
    settings_.time += seconds * speed_;
    update();
}

void Stage::geometryChange(const QRectF& to, const QRectF& from) {
    QQuickItem::geometryChange(to, from);
    update();
}

/// On the render thread, but the GUI thread waits: here both may look at what the other has.
QSGNode* Stage::updatePaintNode(QSGNode* old, UpdatePaintNodeData*) {
    if (device_ == nullptr || width() <= 0.0 || height() <= 0.0)
        return old;
    auto* node = static_cast<StageNode*>(old);
    if (node == nullptr)
        node = new StageNode(*window(), *device_, settings_.recording);
    settings_.clip = std::max(clip_, 0);
    settings_.scheme = scheme_;
    settings_.rate = rate_;
    settings_.count = count_;
    settings_.yaw = yaw_;
    settings_.pitch = pitch_;
    settings_.distance = distance_;
    settings_.covered = covered_;
    node->sync(settings_, boundingRect(), window()->effectiveDevicePixelRatio());
    const QStringList clips = report_.clips;
    node->report(report_);
    // QML must hear of it on its own thread, once this is over.
    if (clips != report_.clips)
        QMetaObject::invokeMethod(this, &Stage::clipsChanged, Qt::QueuedConnection);
    QMetaObject::invokeMethod(this, &Stage::reported, Qt::QueuedConnection);
    return node;
}

} // namespace qt_quick
