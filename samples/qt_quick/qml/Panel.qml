// What can be chosen, and what it costs.
import QtQuick
import QtQuick.Controls.Basic

Rectangle {
    id: panel
    required property var stage

    width: 264
    height: column.height + 36
    radius: 14
    color: "#d0141a23"
    border.color: "#22ffffff"

    palette {
        window: "#1b222c"
        windowText: "#e6ebf0"
        text: "#e6ebf0"
        buttonText: "#e6ebf0"
        button: "#2c3644"
        base: "#1f2732"
        mid: "#3a4656"
        midlight: "#35404f"
        light: "#35404f"
        dark: "#7fd1c3"
        highlight: "#7fd1c3"
        highlightedText: "#10151c"
    }

    // No press goes through to the stage.
    MouseArea { anchors.fill: parent }

    Column {
        id: column
        anchors { left: parent.left; right: parent.right; top: parent.top; margins: 18 }
        spacing: 12

        Text { text: "Supple in Qt Quick"; color: "#ffffff"; font { pixelSize: 18; weight: Font.DemiBold } }
        Text { text: panel.stage.summary; color: "#8d98a5"; width: parent.width; wrapMode: Text.Wrap; font.pixelSize: 12; lineHeight: 1.25 }

        Choice { label: "Character"; model: panel.stage.characters; current: panel.stage.character; onChosen: index => panel.stage.character = index }
        Choice { label: "Clip"; model: panel.stage.clips; current: panel.stage.clip; onChosen: index => panel.stage.clip = index }
        Choice {
            // As SuppleScheme numbers them.
            label: "Surface"
            model: ["as it suits", "p-rep", "P_m", "Catmull-Clark", "Loop", "blend", "polygons"]
            current: panel.stage.scheme
            onChosen: index => panel.stage.scheme = index
        }
        Amount { label: "Speed"; from: 0; to: 2; step: 0.05; value: panel.stage.speed; digits: 2; onMoved: to => panel.stage.speed = to }
        Amount { label: "Segments along an edge"; from: 1; to: 12; value: panel.stage.rate; onMoved: to => panel.stage.rate = to }
        Amount { label: "Characters"; from: 1; to: 19; value: panel.stage.count; onMoved: to => panel.stage.count = to }

        Rectangle { width: parent.width; height: 1; color: "#22ffffff"; visible: showTimings }
        Passes { width: parent.width; list: panel.stage.passes; visible: showTimings }
    }
}
