// One of a list. A user's choice ends a binding of currentIndex, and so does a new list: it is set instead.
import QtQuick
import QtQuick.Controls.Basic

Row {
    id: choice
    property alias label: name.text
    property alias model: box.model
    property int current: 0
    signal chosen(int index)

    width: parent.width
    onCurrentChanged: box.currentIndex = current
    Text { id: name; width: 84; height: box.height; verticalAlignment: Text.AlignVCenter; color: "#aab4bf"; font.pixelSize: 13 }
    ComboBox {
        id: box
        width: parent.width - name.width
        height: 32
        font.pixelSize: 13
        onModelChanged: Qt.callLater(() => currentIndex = choice.current)
        onActivated: index => choice.chosen(index)
    }
}
