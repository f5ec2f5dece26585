#include "client/gui/sheet/add_sheet.h"

#include "client/gui/app/on_pool.h"
#include "client/gui/sheet/sheet_base.h"
#include "client/gui/sheet/sheet_page.h"

namespace metamer::gui {
namespace {

const QStringList& first_lights() {
  static const QStringList lights{QStringLiteral("D65"), QStringLiteral("A"),
                                  QStringLiteral("F11")};
  return lights;
}

/// The page and what works for it; it asks anew for what has changed meanwhile.
class SheetRoom : public QObject {
 public:
  explicit SheetRoom(MainWindow& window)
      : QObject(&window), window_(window), finder_(new SheetBaseFinder(window)) {
    connect(finder_, &SheetBaseFinder::rendering, this, [this] {
      if (page_) page_->show_busy(SheetPage::tr("rendering a small picture with factors …"));
    });
    connect(finder_, &SheetBaseFinder::failed, this, [this](const QString& why) {
      if (page_) page_->show_fault(why);
    });
    connect(finder_, &SheetBaseFinder::found, this, [this](const auto& base) { make(base); });
  }

  void show() {
    if (window_.document() == nullptr || !window_.document()->sound())
      return window_.say(SheetPage::tr("the scene has problems"));
    const bool fresh = page_ == nullptr;
    if (fresh) {
      page_ = new SheetPage;
      connect(page_, &SheetPage::asked, this, [this] { ask(); });
    }
    const auto files = window_.document()->sound();
    QStringList paints;
    for (const v1::Material& material : files->scene().material())
      paints << QString::fromStdString(material.name());
    page_->set_choices(paints, first_lights());
    window_.show_picture(page_, SheetPage::tr("Sheet"));
    page_->setFocus();
    if (fresh) suggest(files);
  }

 private:
  /// A pair of the scene's that is metameric, where there is one; the sheet of it comes by itself.
  void suggest(const std::shared_ptr<const client::CheckedScene>& files) {
    const auto work = [files] { return pair_of(files->scene(), *files, first_lights()); };
    on_pool(page_, work, [this](const std::optional<std::pair<QString, QString>>& pair) {
      if (pair) page_->suggest(pair->first, pair->second);
      ask();
    });
  }

  void ask() {
    page_->show_busy(SheetPage::tr("looking for a picture with factors …"));
    finder_->find();
  }

  void make(const std::shared_ptr<const SheetBase>& base) {
    if (page_ == nullptr) return;
    page_->show_busy(SheetPage::tr("relighting …"));
    const auto work = [base, wish = page_->wish()]() -> Result<std::shared_ptr<const MadeSheet>> {
      return make_sheet(*base, wish).map([](MadeSheet&& made) {
        return std::make_shared<const MadeSheet>(std::move(made));
      });
    };
    on_pool(page_, work, [this](const Result<std::shared_ptr<const MadeSheet>>& made) {
      made ? page_->show_sheet(*made)
           : page_->show_fault(QString::fromStdString(made.error().message));
    });
  }

  MainWindow& window_;
  SheetBaseFinder* finder_;
  QPointer<SheetPage> page_;
};

}  // namespace

void add_sheet(MainWindow& window) {
  auto* room = new SheetRoom(window);
  window.actions().bind(QStringLiteral("compare.sheet"), [room] { room->show(); });
}

}  // namespace metamer::gui
