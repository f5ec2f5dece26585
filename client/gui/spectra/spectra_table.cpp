#include "client/gui/spectra/spectra_table.h"

#include <QMimeData>
#include <algorithm>
#include <cmath>

#include "client/tools/spectra/spectra_change.h"

namespace metamer::gui {
namespace {

QVariant light_value(const client::EmissionFacts& facts, const Viewer& viewer, int column) {
  const client::ObservedLight& seen = seen_by(facts, viewer);
  switch (column) {
    case SpectraTable::luminance:
      return seen.luminance;
    case SpectraTable::x:
      return seen.chromaticity ? QVariant(seen.chromaticity->x) : QVariant();
    case SpectraTable::y:
      return seen.chromaticity ? QVariant(seen.chromaticity->y) : QVariant();
    case SpectraTable::temperature:
      return facts.temperature ? QVariant(facts.temperature->kelvin) : QVariant();
    case SpectraTable::rendering:
      return facts.rendering ? QVariant(facts.rendering->ra) : QVariant();
    default:
      return {};
  }
}

QVariant material_value(const client::ReflectanceFacts& facts, int column) {
  switch (column) {
    case SpectraTable::luminance:
      return facts.luminance;
    case SpectraTable::x:
      return facts.chromaticity ? QVariant(facts.chromaticity->x) : QVariant();
    case SpectraTable::y:
      return facts.chromaticity ? QVariant(facts.chromaticity->y) : QVariant();
    default:
      break;
  }
  if (!facts.lab) return {};
  const double lab[] = {facts.lab->l, facts.lab->a, facts.lab->b};
  return lab[column - SpectraTable::lights_only];
}

/// As many digits as a value is known to.
QString shown(double value, int column, SpectraTable::Kind kind) {
  switch (column) {
    case SpectraTable::x:
    case SpectraTable::y:
      return QString::number(value, 'f', 4);
    case SpectraTable::luminance:
    case SpectraTable::least:
    case SpectraTable::most:
      return QString::number(value, 'g', 5);
    default:
      break;
  }
  const QString text = QString::number(value, 'f', kind == SpectraTable::Kind::lights ? 0 : 2);
  return text == QStringLiteral("-0.00") ? QStringLiteral("0.00") : text;
}

QString nm_range(const client::SpectrumFacts& facts) {
  return QStringLiteral("%1–%2").arg(QString::fromStdString(number_text(facts.from)),
                                     QString::fromStdString(number_text(facts.to)));
}

}  // namespace

SpectraTable::SpectraTable(Kind kind, QObject* parent) : QAbstractTableModel(parent), kind_(kind) {}

void SpectraTable::add(const Listed& row) {
  const auto same = std::find_if(rows_.begin(), rows_.end(), [&](const Listed& one) {
    return !row->word().isEmpty() && one->word() == row->word();
  });
  if (same != rows_.end()) {
    *same = row;
    const int at = static_cast<int>(same - rows_.begin());
    Q_EMIT dataChanged(index(at, 0), index(at, columnCount() - 1));
    return;
  }
  const int end = static_cast<int>(rows_.size());
  beginInsertRows({}, end, end);
  rows_ << row;
  endInsertRows();
}

void SpectraTable::replace(const QList<Listed>& rows) {
  Q_ASSERT(rows.size() == rows_.size());
  rows_ = rows;
  if (!rows_.isEmpty()) Q_EMIT dataChanged(index(0, 0), index(rowCount() - 1, columnCount() - 1));
}

int SpectraTable::rowCount(const QModelIndex& parent) const {
  return parent.isValid() ? 0 : static_cast<int>(rows_.size());
}

int SpectraTable::columnCount(const QModelIndex& parent) const {
  if (parent.isValid()) return 0;
  return lights_only + (kind_ == Kind::lights ? 2 : 3);
}

QVariant SpectraTable::value(const ListedSpectrum& one, int column) const {
  switch (column) {
    case name:
      return one.label();
    case kind:
      return QString::fromStdString(quantity_text(one.spectrum().quantity));
    case range:
      return one.facts.from;
    case samples:
      return static_cast<int>(one.facts.samples);
    case least:
      return one.facts.min;
    case most:
      return one.facts.max;
    default:
      break;
  }
  if (const auto* light = std::get_if<client::EmissionFacts>(&one.facts.look))
    return light_value(*light, viewer_, column);
  return material_value(std::get<client::ReflectanceFacts>(one.facts.look), column);
}

QVariant SpectraTable::data(const QModelIndex& index, int role) const {
  if (!index.isValid() || index.row() >= rowCount()) return {};
  const ListedSpectrum& one = *rows_[index.row()];
  const QVariant raw = value(one, index.column());
  switch (role) {
    case value_role:
      return raw;
    case Qt::DisplayRole:
      if (index.column() == range) return nm_range(one.facts);
      if (!raw.isValid()) return QStringLiteral("–");
      return raw.typeId() == QMetaType::Double ? shown(raw.toDouble(), index.column(), kind_) : raw;
    case Qt::EditRole:
      return raw.typeId() == QMetaType::Double ? QString::number(raw.toDouble(), 'g', 8) : raw;
    case Qt::TextAlignmentRole:
      return QVariant(Qt::AlignVCenter | (index.column() <= kind ? Qt::AlignLeft : Qt::AlignRight));
    case Qt::ToolTipRole: {
      QStringList lines{one.word().isEmpty() ? tr("written in the scene") : one.word()};
      for (const std::string& note : one.spectrum().notes) lines << QString::fromStdString(note);
      return lines.join(QLatin1Char('\n'));
    }
    default:
      return {};
  }
}

QVariant SpectraTable::headerData(int section, Qt::Orientation orientation, int role) const {
  if (orientation != Qt::Horizontal || section < 0 || section >= columnCount()) return {};
  const bool light = kind_ == Kind::lights;
  static const QStringList common{tr("Name"), tr("Kind"), tr("nm"), tr("Samples"), tr("Y"),
                                  tr("Min"),  tr("Max"),  tr("x"),  tr("y")};
  static const QStringList lights{tr("CCT / K"), tr("Ra")};
  static const QStringList materials{tr("L*"), tr("a*"), tr("b*")};
  if (role == Qt::ToolTipRole && section == luminance)
    return light ? tr("Luminance to the observer; type another to set it")
                 : tr("Share of the light's luminance, under the chosen light");
  if (role != Qt::DisplayRole) return {};
  if (section < lights_only) return common[section];
  return (light ? lights : materials)[section - lights_only];
}

Qt::ItemFlags SpectraTable::flags(const QModelIndex& index) const {
  Qt::ItemFlags flags = QAbstractTableModel::flags(index);
  if (!index.isValid()) return flags;
  if (!rows_[index.row()]->word().isEmpty()) flags |= Qt::ItemIsDragEnabled;
  if (kind_ == Kind::lights && index.column() == luminance) flags |= Qt::ItemIsEditable;
  return flags;
}

bool SpectraTable::setData(const QModelIndex& index, const QVariant& value, int role) {
  if (role != Qt::EditRole || !flags(index).testFlag(Qt::ItemIsEditable)) return false;
  bool is_number = false;
  const double wanted = value.toDouble(&is_number);
  if (!is_number || !(wanted > 0) || !std::isfinite(wanted)) {
    Q_EMIT refused(tr("a luminance is a number above 0"));
    return false;
  }
  client::WordedSpectrum worded = rows_[index.row()]->worded;
  const auto normalized = client::normalized(worded.spectrum, viewer_.observer, wanted);
  if (!normalized) {
    Q_EMIT refused(QString::fromStdString(normalized.error().message));
    return false;
  }
  worded.spectrum = client::scaled(std::move(worded.spectrum), normalized->factor);
  const Result<Listed> row = listed(std::move(worded), viewer_);
  if (!row) return false;
  rows_[index.row()] = *row;
  Q_EMIT dataChanged(this->index(index.row(), 0), this->index(index.row(), columnCount() - 1));
  return true;
}

bool SpectraTable::removeRows(int row, int count, const QModelIndex& parent) {
  if (parent.isValid() || row < 0 || count < 1 || row + count > rowCount()) return false;
  beginRemoveRows({}, row, row + count - 1);
  rows_.remove(row, count);
  endRemoveRows();
  return true;
}

QStringList SpectraTable::mimeTypes() const { return {QStringLiteral("text/plain")}; }

QMimeData* SpectraTable::mimeData(const QModelIndexList& indexes) const {
  QStringList words;
  for (const QModelIndex& index : indexes)
    if (const QString word = rows_[index.row()]->word(); !word.isEmpty() && !words.contains(word))
      words << word;
  auto* data = new QMimeData;
  data->setText(words.join(QLatin1Char('\n')));
  return data;
}

}  // namespace metamer::gui
