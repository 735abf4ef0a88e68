// Supple in someone else's engine: Qt Quick. The window is QML's; one of its items, the stage, shows Supple's
// characters.
//
//     supple_qt_quick [--frames N --picture out.png [--without-timings]] [--set [FRAME:]PROPERTY=NUMBER ...]
//     [CHARACTER.glb ...]
#include "characters.h"
#include "device.h"
#include "stage.h"
#include "validation.h"

#include <QCommandLineParser>
#include <QElapsedTimer>
#include <QGuiApplication>
#include <QQmlContext>
#include <QQuickView>
#include <QRegularExpression>
#include <QSGRendererInterface>

#include <algorithm>
#include <memory>

namespace qt_quick {

namespace {

constexpr double kStep = 1.0 / 30.0; // seconds between two frames, with --frames: every run shows the same

/// A control that is turned when so many frames have been shown, as a user would.
struct Change {
    int frame = 0;
    QByteArray property;
    int value = 0;
};

struct Options {
    int frames = 0; ///< 0: until the window is closed
    QList<Change> changes;
    QString picture;
    bool timings = true;
    QSize size{1280, 720};
    QString recording;
    QStringList files;
};

/// "[FRAME:]PROPERTY=VALUE"
Change parseChange(const QString& text) {
    const QRegularExpressionMatch match = QRegularExpression("^(?:(\\d+):)?(\\w+)=(\\d+)$").match(text);
    if (!match.hasMatch())
        fail("--set wants [FRAME:]PROPERTY=NUMBER", 2);
    return {match.captured(1).toInt(), match.captured(2).toLatin1(), match.captured(3).toInt()};
}

void apply(Stage& stage, const QList<Change>& changes, int frame) {
    for (const Change& change : changes)
        if (change.frame == frame && !stage.setProperty(change.property, change.value))
            fail("--set: the stage has no such property", 2);
}

Options parse(const QGuiApplication& application) {
    QCommandLineParser parser;
    parser.setApplicationDescription("Supple's characters in a Qt Quick window");
    parser.addHelpOption();
    const QCommandLineOption frames("frames", "Show so many frames, then end.", "N");
    const QCommandLineOption picture("picture", "Write what the window then shows.", "out.png");
    const QCommandLineOption quiet("without-timings", "Leave out the figures, which differ from run to run.");
    const QCommandLineOption size("size", "Size of the window.", "WxH", "1280x720");
    const QCommandLineOption set("set", "Sets a property of the stage, at once or after so many frames.",
                                 "[FRAME:]P=V");
    const QCommandLineOption record("record", "Write a recording of all calls, for supple replay.", "out.supprec");
    parser.addOptions({frames, picture, quiet, size, set, record});
    parser.addPositionalArgument("files", "Characters; without any: Pip.", "[CHARACTER.glb ...]");
    parser.process(application);
    Options options;
    options.frames = parser.value(frames).toInt();
    options.picture = parser.value(picture);
    options.timings = !parser.isSet(quiet);
    options.recording = parser.value(record);
    for (const QString& text : parser.values(set))
        options.changes += parseChange(text);
    const QStringList numbers = parser.value(size).split('x');
    if (numbers.size() == 2)
        options.size = QSize(numbers[0].toInt(), numbers[1].toInt());
    if (options.size.isEmpty() || (!options.picture.isEmpty() && options.frames < 1))
        fail("--size wants WxH, --picture wants --frames", 2);
    options.files = parser.positionalArguments();
    if (options.files.isEmpty())
        options.files = {SUPPLE_SAMPLE_ASSETS "/pip.glb", SUPPLE_SAMPLE_ASSETS "/pip_quads.glb"};
    return options;
}

/// The clip goes on with every frame that has been shown, and after the last one the window is looked at.
void run(QQuickView& view, Stage& stage, const Options& options) {
    auto clock = std::make_shared<QElapsedTimer>();
    clock->start();
    auto shown = std::make_shared<int>(0);
    // Qt emits it on its render thread; with &stage to name the thread, this runs on the GUI's.
    QObject::connect(&view, &QQuickWindow::frameSwapped, &stage, [&view, &stage, options, clock, shown] {
        if (options.frames == 0) {
            stage.advance(std::min(1e-9 * static_cast<double>(clock->nsecsElapsed()), 0.1)); // less after a pause
            clock->start();
            return;
        }
        if (++*shown > options.frames)
            return;
        apply(stage, options.changes, *shown);
        stage.advance(kStep);
        view.update(); // also if nothing moves
        if (*shown < options.frames)
            return;
        if (!options.picture.isEmpty() && !view.grabWindow().save(options.picture))
            fail("the picture cannot be written");
        QGuiApplication::quit();
    });
}

int show(const Options& options) {
    auto view = std::make_unique<QQuickView>();
    view->setTitle("Supple in Qt Quick");
    view->setResizeMode(QQuickView::SizeRootObjectToView);
    view->resize(options.size);
    const Device device(*view);
    view->rootContext()->setContextProperty("showTimings", options.timings);
    view->setSource(QUrl("qrc:/qt_quick/Main.qml"));
    if (view->status() != QQuickView::Ready)
        fail("the QML modules of Qt Quick are not installed");
    auto* stage = view->rootObject()->findChild<Stage*>("stage");
    stage->open(device, options.files, options.recording);
    apply(*stage, options.changes, 0);
    run(*view, *stage, options);
    view->show();
    const int code = QGuiApplication::exec();
    view.reset(); // it was there before the device, and goes before it as well
    return code;
}

} // namespace

} // namespace qt_quick

int main(int argc, char** argv) {
    using namespace qt_quick;
    const QGuiApplication application(argc, argv);
    QQuickWindow::setGraphicsApi(QSGRendererInterface::Vulkan);
    // Qt's other way to draw text is not the same in every run, and less crisp at this size.
    QQuickWindow::setTextRenderType(QQuickWindow::NativeTextRendering);
    qmlRegisterType<Stage>("Supple", 1, 0, "Stage");
    const int code = show(parse(application));
    return code != 0 || Characters::errors() > 0 || validationMessages() > 0 ? 1 : 0;
}
