// A number, on a slider.
import QtQuick
import QtQuick.Controls.Basic

Column {
    id: dial
    property string label
    property real from: 0
    property real to: 1
    property real step: 1
    property real value: 0
    property int digits: 0
    signal moved(real to)

    width: parent.width
    spacing: 2
    Item {
        width: parent.width
        height: name.height
        Text { id: name; text: dial.label; color: "#aab4bf"; font.pixelSize: 13 }
        Text { anchors.right: parent.right; text: dial.value.toFixed(dial.digits); color: "#e6ebf0"; font.pixelSize: 13 }
    }
    Slider {
        id: slider
        width: parent.width
        height: 24
        palette.window: "#e6ebf0" // the handle
        from: dial.from
        to: dial.to
        stepSize: dial.step
        snapMode: Slider.SnapAlways
        value: dial.value
        onMoved: dial.moved(slider.value)
    }
}
