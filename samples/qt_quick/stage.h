// The stage as QML sees it: an item with properties. GUI thread.
#pragma once

#include "device.h"
#include "settings.h"

#include <QQuickItem>
#include <QVariantList>

namespace qt_quick {

class Stage : public QQuickItem {
    Q_OBJECT
    Q_PROPERTY(QStringList characters READ characters NOTIFY opened)
    Q_PROPERTY(int character READ character WRITE setCharacter NOTIFY changed)
    Q_PROPERTY(int clip MEMBER clip_ NOTIFY changed)
    Q_PROPERTY(double speed MEMBER speed_ NOTIFY changed)
    Q_PROPERTY(int scheme MEMBER scheme_ NOTIFY changed)
    Q_PROPERTY(int rate MEMBER rate_ NOTIFY changed)
    Q_PROPERTY(int count MEMBER count_ NOTIFY changed)
    Q_PROPERTY(double yaw MEMBER yaw_ NOTIFY changed)
    Q_PROPERTY(double pitch MEMBER pitch_ NOTIFY changed)
    Q_PROPERTY(double distance MEMBER distance_ NOTIFY changed)
    Q_PROPERTY(double covered MEMBER covered_ NOTIFY changed)
    Q_PROPERTY(QStringList clips READ clips NOTIFY clipsChanged)
    Q_PROPERTY(QString summary READ summary NOTIFY reported)
    Q_PROPERTY(QString refusal READ refusal NOTIFY reported)
    Q_PROPERTY(QVariantList passes READ passes NOTIFY reported)

public:
    Stage();

    /// Before the stage is shown. The device must outlive the window.
    void open(const Device& device, const QStringList& files, const QString& recording);
    /// Moves the clip on by so many seconds, at its speed, and asks for a new frame.
    void advance(double seconds);

    QStringList characters() const;
    QStringList clips() const { return report_.clips; }
    QString summary() const { return report_.summary; }
    QString refusal() const { return report_.refusal; }
    QVariantList passes() const;
    int character() const { return settings_.character; }
    void setCharacter(int character);

signals:
    void opened();
    void changed();
    void clipsChanged();
    void reported();

protected:
    QSGNode* updatePaintNode(QSGNode* node, UpdatePaintNodeData*) override;
    void geometryChange(const QRectF& to, const QRectF& from) override;

private:
    const Device* device_ = nullptr;
    Settings settings_;
    Report report_;
    int clip_ = 0;
    int scheme_ = settings_.scheme;
    int rate_ = settings_.rate;
    int count_ = settings_.count;
    double speed_ = 1.0;
    double yaw_ = settings_.yaw;
    double pitch_ = settings_.pitch;
    double distance_ = settings_.distance;
    double covered_ = settings_.covered;
};

} // namespace qt_quick
