#include "client/gui/models/models_page.h"

#include <QHBoxLayout>
#include <QScrollArea>
#include <QSplitter>
#include <QVBoxLayout>

#include "client/gui/app/on_pool.h"
#include "client/tools/figures/source_figures.h"

namespace metamer::gui {
namespace {

// What a row of the tree is: the place of a line of the catalogue, or of a diagram of the source.
constexpr int item_role = Qt::UserRole, source_role = Qt::UserRole + 1;

QString utf8(const char* text) { return QString::fromUtf8(text); }

QTreeWidgetItem* add_group(QTreeWidget& tree, const QString& name) {
  auto* group = new QTreeWidgetItem(&tree, {name});
  group->setFlags(Qt::ItemIsEnabled);
  group->setExpanded(true);
  return group;
}

QString paragraph(const QString& text) {
  return QStringLiteral("<p>%1</p>").arg(text.toHtmlEscaped());
}

}  // namespace

ModelsPage::ModelsPage(QWidget* parent)
    : QWidget(parent),
      items_(client::catalogue()),
      tree_(new QTreeWidget),
      text_(new QLabel),
      set_(new QWidget),
      reset_(new QPushButton(tr("Leave all to the &diagram"))),
      plot_(new FigurePlot) {
  setObjectName(QStringLiteral("models"));
  tree_->setHeaderHidden(true);
  tree_->setAccessibleName(tr("Models"));
  tree_->setMinimumWidth(180);
  auto* splitter = new QSplitter;
  splitter->addWidget(tree_);
  splitter->addWidget(make_right());
  splitter->setSizes({220, 700});
  splitter->setChildrenCollapsible(false);
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->addWidget(splitter);
  connect(tree_, &QTreeWidget::currentItemChanged, this, &ModelsPage::choose);
  connect(reset_, &QPushButton::clicked, this, [this] {
    for (ParameterBox* one : parameters_) one->leave();
  });
  fill_tree();
  // The source's diagrams take a moment.
  on_pool(this, &client::source_figures, [this](const std::vector<client::Figure>& figures) {
    source_ = figures;
    QTreeWidgetItem* group = add_group(*tree_, tr("The source's diagrams"));
    for (int i = 0; i < static_cast<int>(source_.size()); ++i) {
      const client::Figure& one = source_[static_cast<std::size_t>(i)];
      auto* row = new QTreeWidgetItem(group, {QString::fromStdString(one.title)});
      row->setData(0, source_role, i);
      row->setToolTip(0, QString::fromStdString(one.title));
    }
  });
}

QWidget* ModelsPage::make_right() {
  text_->setWordWrap(true);
  text_->setTextInteractionFlags(Qt::TextSelectableByMouse | Qt::TextSelectableByKeyboard);
  text_->setAccessibleName(tr("Equation, paper and laws"));
  text_->setMargin(8);
  form_ = new QFormLayout(set_);
  form_->setContentsMargins(8, 0, 8, 0);
  auto* save = new QPushButton(tr("&Save diagram…"));
  connect(save, &QPushButton::clicked, plot_, &FigurePlot::save_as);
  auto* buttons = new QHBoxLayout;
  buttons->setContentsMargins(8, 0, 8, 4);
  buttons->addWidget(reset_);
  buttons->addStretch();
  buttons->addWidget(save);

  auto* top = new QWidget;
  auto* said = new QVBoxLayout(top);
  said->setContentsMargins(0, 0, 0, 0);
  said->addWidget(text_);
  said->addWidget(set_);
  said->addStretch();
  auto* scroll = new QScrollArea;
  scroll->setWidget(top);
  scroll->setWidgetResizable(true);
  scroll->setFrameShape(QFrame::NoFrame);
  auto* upper = new QWidget;
  auto* column = new QVBoxLayout(upper);
  column->setContentsMargins(0, 0, 0, 0);
  column->addWidget(scroll, 1);
  column->addLayout(buttons);
  auto* right = new QSplitter(Qt::Vertical);
  right->addWidget(upper);
  right->addWidget(plot_);
  right->setSizes({330, 470});
  right->setChildrenCollapsible(false);
  return right;
}

void ModelsPage::fill_tree() {
  QTreeWidgetItem* group = nullptr;
  for (int i = 0; i < static_cast<int>(items_.size()); ++i) {
    const client::CatalogueItem& item = items_[static_cast<std::size_t>(i)];
    if (group == nullptr || group->text(0) != utf8(item.kind))
      group = add_group(*tree_, utf8(item.kind));
    auto* row = new QTreeWidgetItem(group, {utf8(item.name)});
    row->setData(0, item_role, i);
    row->setToolTip(0, utf8(item.citation));
  }
  tree_->setCurrentItem(tree_->topLevelItem(0)->child(0));
}

void ModelsPage::choose() {
  while (form_->rowCount() > 0) form_->removeRow(0);
  parameters_.clear();
  const QTreeWidgetItem* row = tree_->currentItem();
  if (row == nullptr) return;
  if (row->data(0, source_role).isValid()) {
    ++asked_;
    reset_->setEnabled(false);
    const auto& figure = source_[static_cast<std::size_t>(row->data(0, source_role).toInt())];
    text_->setText(
        QStringLiteral("<h3>%1</h3>").arg(QString::fromStdString(figure.title).toHtmlEscaped()) +
        paragraph(QString::fromStdString(figure.citation)));
    plot_->set_figure(figure);
    Q_EMIT shown();
    return;
  }
  if (!row->data(0, item_role).isValid()) return;
  const auto& item = items_[static_cast<std::size_t>(row->data(0, item_role).toInt())];
  describe(item);
  for (const models::Parameter& one : client::plot_parameters(item)) {
    auto* box = new ParameterBox(one);
    form_->addRow(utf8(one.name), box);
    connect(box, &ParameterBox::changed, this, &ModelsPage::ask);
    parameters_.push_back(box);
  }
  reset_->setEnabled(!parameters_.empty());
  ask();
}

void ModelsPage::describe(const client::CatalogueItem& item) {
  QString text = QStringLiteral("<h3>%1 <small>%2</small></h3><p><code>%3 = %4</code></p>")
                     .arg(utf8(item.name).toHtmlEscaped(), utf8(item.kind).toHtmlEscaped(),
                          utf8(item.symbol).toHtmlEscaped(), utf8(item.equation).toHtmlEscaped());
  text += paragraph(utf8(item.citation));
  QStringList laws;
  for (const client::TraitWords& trait : client::traits_of(item)) laws << utf8(trait.sentence);
  if (!laws.isEmpty()) text += paragraph(laws.join(QLatin1Char(' ')));
  text_->setText(text);
}

void ModelsPage::ask() {
  const QTreeWidgetItem* row = tree_->currentItem();
  const auto item = items_[static_cast<std::size_t>(row->data(0, item_role).toInt())];
  client::Values values;
  for (const ParameterBox* one : parameters_)
    if (const auto value = one->value()) values[one->parameter().name] = *value;
  on_pool(
      this, [item, values] { return client::figure_of(item, values); },
      [this, mine = ++asked_](const client::Figure& figure) {
        if (mine != asked_) return;
        plot_->set_figure(figure);
        Q_EMIT shown();
      });
}

}  // namespace metamer::gui
