// What the QML controls choose. The GUI thread writes it, the render thread gets a copy while the GUI thread waits.
#pragma once

#include "vk.h"

#include <QStringList>

namespace qt_quick {

constexpr int kMaxCount = 19; // one in the middle, 6 round it, 12 round these

struct Settings {
    QStringList files;
    QString recording; ///< where a recording of all calls goes, or empty
    int character = 0; ///< of files
    int clip = 0;
    int scheme = SUPPLE_SCHEME_AUTO;
    int rate = 6;
    int count = 7;
    double time = 0.0; ///< seconds of the clip
    double yaw = 20.0; ///< the camera about the middle: degrees
    double pitch = 16.0;
    double distance = 8.2;
    double covered = 0.0; ///< the share of the width, on the right, that the panel lies on
};

/// What comes back, a few frames late.
struct Report {
    struct Pass {
        QString name;
        double milliseconds = 0.0;
    };
    QStringList clips;
    QString summary;
    QString refusal; ///< why the scheme that was chosen is not shown
    QList<Pass> passes;
};

} // namespace qt_quick
