// The stage fills the window; the panel lies on it.
import QtQuick
import Supple

Item {
    Stage {
        id: stage
        objectName: "stage"
        anchors.fill: parent
        covered: (panel.width + 40) / width

        DragHandler {
            target: null
            property point last
            onActiveChanged: last = Qt.point(0, 0)
            onTranslationChanged: {
                stage.yaw -= 0.4 * (translation.x - last.x)
                stage.pitch = Math.max(2, Math.min(80, stage.pitch + 0.3 * (translation.y - last.y)))
                last = Qt.point(translation.x, translation.y)
            }
        }
        WheelHandler {
            target: null
            onWheel: event => stage.distance = Math.max(2.5, Math.min(16, stage.distance * Math.pow(0.999, event.angleDelta.y)))
        }
    }

    Panel {
        id: panel
        stage: stage
        anchors { right: parent.right; top: parent.top; margins: 20 }
    }

    // Why the surface that was chosen is not shown.
    Rectangle {
        anchors { left: parent.left; right: panel.left; bottom: parent.bottom; margins: 20 }
        height: refusal.height + 24
        radius: 10
        color: "#d0402018"
        visible: stage.refusal !== ""
        Text {
            id: refusal
            anchors { left: parent.left; right: parent.right; top: parent.top; margins: 12 }
            text: stage.refusal
            wrapMode: Text.Wrap
            color: "#ffd9c4"
            font.pixelSize: 13
        }
    }
}
