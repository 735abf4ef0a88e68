// suppleGetTimings: a bar for each pass.
import QtQuick

Column {
    id: passes
    property var list: []
    readonly property real sum: list.reduce((sum, pass) => sum + pass.milliseconds, 0)
    readonly property real longest: list.reduce((most, pass) => Math.max(most, pass.milliseconds), 1e-6)

    spacing: 5
    Item {
        width: parent.width
        height: total.height
        Text { id: total; text: "Supple's passes"; color: "#aab4bf"; font.pixelSize: 13 }
        Text { anchors.right: parent.right; text: passes.sum.toFixed(2) + " ms"; color: "#e6ebf0"; font.pixelSize: 13 }
    }
    Repeater {
        model: passes.list
        Item {
            required property var modelData
            width: passes.width
            height: 16
            Text { text: modelData.name; color: "#8d98a5"; font.pixelSize: 12 }
            Rectangle {
                x: 84
                y: 5
                width: Math.max(2, (parent.width - 84 - 62) * modelData.milliseconds / passes.longest)
                height: 6
                radius: 3
                color: "#7fd1c3"
            }
            Text { anchors.right: parent.right; text: modelData.milliseconds.toFixed(2); color: "#c8d2dc"; font.pixelSize: 12 }
        }
    }
}
