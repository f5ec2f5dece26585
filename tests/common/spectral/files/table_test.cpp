// Tables of spectra, through read_spectrum_file.
#include <gtest/gtest.h>

#include "common/spectral/files/interpret.h"
#include "common/spectral/files/spectrum_file.h"

namespace metamer {
namespace {

SpectrumFile table(std::string_view text) {
  auto read = read_spectrum_file(text, "t.csv");
  if (!read) ADD_FAILURE() << format(read.error()) << " of " << text;
  return read ? std::move(*read) : SpectrumFile{};
}

std::string table_error(std::string_view text) {
  const auto read = read_spectrum_file(text, "t.csv");
  return read ? "no error" : format(read.error());
}

Spectrum only_of(std::string_view text) {
  const SpectrumFile file = table(text);
  EXPECT_EQ(file.spectra.size(), 1U) << text;
  return file.spectra.empty() ? Spectrum{} : file.spectra.front().spectrum;
}

const Spectrum fabric = {{380, 390, 400}, {0.25, 0.5, 0.125}};

TEST(Table, IsReadWithEverySeparatorAndDecimalSign) {
  EXPECT_EQ(only_of("380,0.25\n390,0.5\n400,0.125\n"), fabric);
  EXPECT_EQ(only_of("380, 0.25\n390, 0.5\n400, 0.125\n"), fabric);
  EXPECT_EQ(only_of("380;0.25\n390;0.5\n400;0.125"), fabric);
  EXPECT_EQ(only_of("380;0,25\n390;0,5\n400;0,125\n"), fabric);
  EXPECT_EQ(only_of("380\t0.25\n390\t0.5\n400\t0.125\n"), fabric);
  EXPECT_EQ(only_of("380\t0,25\n390\t0,5\n400\t0,125\n"), fabric);
  EXPECT_EQ(only_of("380 0,25\n390 0,5\n400 0,125\n"), fabric);
  EXPECT_EQ(only_of("380,00;2,5e-1\n390,00;0,5\n400,00;1,25E-1\n"), fabric);
  EXPECT_EQ(only_of("\"380\";\"0,25\"\n\"390\";\"0,5\"\n\"400\";\"0,125\"\n"), fabric);
  EXPECT_EQ(only_of("380,0.25,\n390,0.5,\n400,0.125,\n"), fabric) << "a comma at the end";
}

TEST(Table, ReadsOverHeadingsAndRemarks) {
  EXPECT_EQ(only_of("Wavelength,Reflectance\n380,0.25\n390,0.5\n400,0.125\n"), fabric);
  EXPECT_EQ(
      only_of("Date: 2024-05-17\nSpectrometer: 7\n\nnm\tR\n380\t0.25\n390\t0.5\n400\t0.125\n"),
      fabric);
  EXPECT_EQ(only_of("# 12, 13\n380,0.25\n# between\n390,0.5\n400,0.125\n"), fabric);
  EXPECT_EQ(only_of("380,0.25\n390,0.5\n400,0.125\n>>>>>End Spectral Data<<<<<\n"), fabric);
}

TEST(Table, MayFall) {
  EXPECT_EQ(only_of("400 0.125\n390 0.5\n380 0.25\n"), fabric);
  EXPECT_EQ(only_of("nm;a\n400;0,125\n390;0,5\n380;0,25\n"), fabric);
  EXPECT_EQ(table_error("400 1\n390 1\n395 1\n"),
            "t.csv:3:1: error: wavelengths must go on falling: 395 follows 390");
  EXPECT_EQ(table_error("400 1\n390 1\n390 1\n"), "t.csv:3:1: error: wavelength 390 is repeated");
}

TEST(Table, NamesItsColumns) {
  const SpectrumFile file =
      table("Wavelength [nm];Cotton 100%;\"Wool; red\"\n380;1;2\n390;3;4\n400;5;6\n");
  ASSERT_EQ(file.spectra.size(), 2U);
  EXPECT_EQ(file.spectra[0].name, "Cotton 100%");
  EXPECT_EQ(file.spectra[1].name, "Wool; red");
  EXPECT_EQ(file.spectra[1].spectrum, (Spectrum{{380, 390, 400}, {2, 4, 6}}));
  EXPECT_FALSE(file.scale);
  EXPECT_EQ(table("380 1 2\n390 3 4\n").spectra[1].name, "column 3");
  EXPECT_EQ(table("# nm a b\n380 1 2\n390 3 4\n").spectra[0].name, "a");
  EXPECT_EQ(table("pixel,Wavelength (nm),a\n0,380,1\n1,390,2\n").spectra.front().spectrum,
            (Spectrum{{380, 390}, {1, 2}}));
}

TEST(Table, LeavesOutWhatACellDoesNotSay) {
  const SpectrumFile file = table("nm,a,b,c\n380,1,,\n390,2,3,\n400,,4,\n");
  ASSERT_EQ(file.spectra.size(), 2U);
  EXPECT_EQ(file.spectra[0].spectrum, (Spectrum{{380, 390}, {1, 2}}));
  EXPECT_EQ(file.spectra[1].spectrum, (Spectrum{{390, 400}, {3, 4}}));
}

TEST(Table, KnowsTheLargestOfAllItsValues) {
  EXPECT_EQ(table("nm,a,b\n400,1,85\n500,2,3\n").largest, 85);
}

TEST(Table, WithoutAValueIsNone) {
  EXPECT_EQ(table_error("nm,a\n380,\n390,\n"),
            "t.csv: error: the file has wavelengths, but no values");
}

TEST(Table, TakesUnitsAndQuantitiesOfItsHeadings) {
  EXPECT_EQ(only_of("Wavelength (µm),R\n0.38,0.25\n0.39,0.5\n0.4,0.125\n"), fabric);
  EXPECT_EQ(only_of("wavelength / um\tn\n0.38\t0.25\n0.39\t0.5\n0.4\t0.125\n"), fabric);
  EXPECT_EQ(only_of("0.38um,0.25\n0.39um,0.5\n0.40um,0.125\n"), fabric);
  const SpectrumFile percent = table("Wavelength [nm];R [%]\n360;4,12\n370;4,50\n");
  EXPECT_EQ(percent.scale, Scale::percent);
  EXPECT_EQ(percent.spectra.front().spectrum, (Spectrum{{360, 370}, {4.12, 4.5}}));
  EXPECT_EQ(table("nm,Transmittance\n380,1\n390,2\n").quantity, Quantity::transmittance);
  EXPECT_EQ(table("Spectral radiance\nnm,W\n380,1\n390,2\n").quantity, Quantity::emission);
}

TEST(Table, OfMicrometresWithoutAWordIsAnError) {
  const std::string_view gold = "0.4133 1.64\n0.4959 1.04\n";
  EXPECT_EQ(
      table_error(gold),
      "t.csv:1:1: error: wavelengths from 0.4133 to 0.4959 look like µm; say in which unit they "
      "are (um or nm)");
  const auto stated = read_spectrum_file(gold, "t.csv", WavelengthUnit::um);
  ASSERT_TRUE(stated);
  EXPECT_EQ(stated->spectra.front().spectrum, (Spectrum{{413.3, 495.9}, {1.64, 1.04}}));
  EXPECT_TRUE(read_spectrum_file(gold, "t.csv", WavelengthUnit::nm));
}

TEST(Table, MayHaveASpectrumALine) {
  const SpectrumFile file = table("Name,380,390,400\nred,0.1,0.2,0.3\nblue,0.4,0.5,0.6\n");
  ASSERT_EQ(file.spectra.size(), 2U);
  EXPECT_EQ(file.spectra[1].name, "blue");
  EXPECT_EQ(file.spectra[1].spectrum, (Spectrum{{380, 390, 400}, {0.4, 0.5, 0.6}}));
  EXPECT_EQ(table("id;Name;SPEC_400;SPEC_390;SPEC_380\n1;a;0,3;0,2;0,1\n").spectra.front().spectrum,
            (Spectrum{{380, 390, 400}, {0.1, 0.2, 0.3}}));
  EXPECT_EQ(table("\tnm380\tnm390\tnm400\nred\t1\t\t3\n").spectra.front().spectrum,
            (Spectrum{{380, 400}, {1, 3}}));
  EXPECT_EQ(
      table("Exported 2024\nsample,0.38um,0.39um,0.40um\na,1,2,3\n").spectra.front().spectrum.nm,
      (std::vector<double>{380, 390, 400}));
}

TEST(Table, ASpectrumALineIsKnownByEveryHeading) {
  for (const char* heading :
       {"name,R400,R410,R420", "name,R[400nm],R[410nm],R[420nm]", "name,R(400),R(410),R(420)",
        "id;nm400;nm410;nm420", "id\tSPEC400\tSPEC410\tSPEC420", "x,T400,T410,T420"}) {
    std::string row = "red,0.1,0.2,0.3\n";
    const char delimiter = std::string_view(heading).find_first_of(",;\t") != std::string_view::npos
                               ? heading[std::string_view(heading).find_first_of(",;\t")]
                               : ',';
    for (char& c : row) c = c == ',' ? delimiter : c;
    const SpectrumFile file = table(std::string(heading) + "\n" + row);
    EXPECT_EQ(file.spectra.at(0).name, "red") << heading;
    EXPECT_EQ(file.spectra.at(0).spectrum, (Spectrum{{400, 410, 420}, {0.1, 0.2, 0.3}})) << heading;
  }
}

TEST(Table, OfAnInstrumentIsCalledAfterIt) {
  const std::string sekonic =
      "Sekonic C-7000,\nCCT,5003\nSpectral Data 380[nm],0.25\nSpectral Data 390[nm],0.5\n"
      "Spectral Data 400[nm],0.125\nMemo,none\n";
  EXPECT_EQ(table(sekonic).format, "Sekonic's export");
  EXPECT_EQ(only_of(sekonic), fabric);
  EXPECT_EQ(only_of("Model,MK350\nCCT,5003\n380nm,0.25\n390nm,0.5\n400nm,0.125\n"), fabric);
  EXPECT_EQ(only_of("380[nm]\t0,25\n390[nm]\t0,5\n400[nm]\t0,125\n"), fabric);
}

TEST(Table, LocatesWhatIsWrong) {
  EXPECT_EQ(table_error("380,0.1\n390,abc\n400,0.2\n"),
            "t.csv:2:5: error: \"abc\" is not a number");
  EXPECT_EQ(table_error("380;0,1\n390;0.2.1\n400;0,2\n"),
            "t.csv:2:5: error: \"0.2.1\" is not a number");
  EXPECT_EQ(table_error("380,0.1\nx90,0.2\n400,0.2\n"),
            "t.csv:2:1: error: \"x90\" is not a number");
  EXPECT_EQ(table_error("380,0.1\n390\n400,0.2\n"),
            "t.csv:2:1: error: expected 2 cells as on line 1, not 1");
  EXPECT_EQ(
      table_error("Name,380,390,400\nred,0.1,0.2,x\n"),
      "t.csv:1:1: error: no spectrum: expected \"from to step\", \"wavelength value\" on each "
      "line, a table, or a CGATS file with BEGIN_DATA");
  EXPECT_EQ(table_error("Name,380,390,400\nred,0.1,0.2,0.3\nblue,1,x,3\n"),
            "t.csv:3:8: error: \"x\" is not a number");
  EXPECT_EQ(table_error("Name,380,390,400\nred,0.1,0.2,0.3\nblue,1,2\n"),
            "t.csv:3:1: error: expected 4 cells as on line 1, not 3");
}

TEST(Table, OneColumnInPercentsMakesNoOtherOne) {
  const SpectrumFile file = table("nm,a [%],b [1]\n400,10,0.5\n500,20,0.25\n");
  EXPECT_EQ(file.scale, Scale::percent);
  EXPECT_EQ(file.spectra[0].spectrum.values, (std::vector<double>{10, 20}));
  EXPECT_EQ(file.spectra[1].spectrum.values, (std::vector<double>{50, 25}));
  EXPECT_EQ(table("Spectral reflectance factor (%)\nnm,a\n400,0.5\n500,0.6\n").scale,
            Scale::percent);
  EXPECT_EQ(table("Reflectance %,400,500,600\nred,1,2,3\n").scale, Scale::percent);
  EXPECT_FALSE(table("Humidity: 45 %\nnm,a\n400,0.5\n500,0.6\n").scale);
}

TEST(Table, MayCallItsSamplesByNumbers) {
  for (const char* heading : {"wavelength,400,500,600", "nm,101,102,103", "nm,1,2,3"}) {
    const SpectrumFile file = table(std::string(heading) + "\n400,1,2,3\n410,4,5,6\n");
    ASSERT_EQ(file.spectra.size(), 3U) << heading;
    EXPECT_EQ(file.spectra[1].spectrum, (Spectrum{{400, 410}, {2, 5}})) << heading;
  }
  EXPECT_EQ(table("nm,101,102\n400,1,2\n410,4,5\n").spectra[0].name, "101");
}

TEST(Table, IsNamedByTheLineAboveItsData) {
  const SpectrumFile file = table("Operator,me,\nDate,x,5\nnm,a,b\n400,1,2\n410,3,4\n");
  EXPECT_EQ(file.spectra.at(0).name, "a");
  EXPECT_EQ(file.spectra.at(1).name, "b");
  EXPECT_EQ(table("nm;Wool;Linen\n;%;%\n400;10;20\n410;30;40\n").spectra.at(1).name, "Linen");
}

TEST(Table, OfOtherAxesAndQuantitiesIsRefused) {
  EXPECT_EQ(table_error("Frequency (THz),R\n428,0.1\n500,0.2\n"),
            "t.csv:1:1: error: wavelengths in nm or µm are needed, not frequencies");
  EXPECT_EQ(table_error("nm,Absorbance\n400,0.1\n500,0.2\n"),
            "t.csv:1:4: error: absorbance is neither a reflectance, a transmittance nor a power");
  EXPECT_EQ(
      table_error("nm,a,nm,b\n400,1,395,2\n410,1,405,2\n"),
      "t.csv:1:6: error: a second column of wavelengths: a table has one; give each its own file");
  EXPECT_EQ(
      table_error("XAxis mode: Raman Shifts\n>>>>>Begin Spectral Data<<<<<\n400\t1\n410\t2\n"),
      "t.csv:1:1: error: wavelengths are needed, and the file has another axis");
}

TEST(Table, OfALampTwiceIsTheFinerOne) {
  const std::string coarse = "Spectral Data 380[nm],1\nSpectral Data 385[nm],2\n";
  const std::string fine =
      "Spectral Data 380[nm],1\nSpectral Data 381[nm],3\nSpectral Data 382[nm],4\n";
  EXPECT_EQ(only_of("Sekonic,C-7000\n" + coarse + fine), (Spectrum{{380, 381, 382}, {1, 3, 4}}));
  EXPECT_EQ(only_of("Sekonic,C-7000\n" + fine + coarse), (Spectrum{{380, 381, 382}, {1, 3, 4}}));
}

TEST(Table, ReadsPercentsBehindNumbers) {
  for (const char* text :
       {"400,10.02%\n500,20%\n600,30.5%\n", "600;30,5 %\n500;20 %\n400;10,02 %\n",
        "nm\tred\n400\t10.02%\n500\t20.00%\n600\t30.50%\n",
        "Name,400,500,600\nred,10.02%,20%,30.5%\n"}) {
    const SpectrumFile file = table(text);
    EXPECT_EQ(file.scale, Scale::percent) << text;
    EXPECT_EQ(file.spectra.at(0).spectrum, (Spectrum{{400, 500, 600}, {10.02, 20, 30.5}})) << text;
  }
  EXPECT_EQ(
      table_error("400,10%\n500,0.2\n600,30%\n"),
      "t.csv:1:1: error: some numbers of column 2 have a % behind them, and others have none");
}

TEST(Table, ReadsThousandsWhereTheyCanBeNothingElse) {
  const Spectrum lamp = {{400, 500, 600}, {1002.5, 999.25, 1234567}};
  for (const char* text :
       {"400;1 002,5\n500;999,25\n600;1 234 567\n", "400\t1'002.5\n500\t999.25\n600\t1'234'567\n",
        "400;1.002,5\n500;999,25\n600;1.234.567,0\n", "400;1,002.5\n500;999.25\n600;1,234,567.0\n",
        "400,\"1,002.5\"\n500,\"999.25\"\n600,\"1,234,567.0\"\n",
        "400;1\xC2\xA0"
        "002,5\n500;999,25\n600;1\xE2\x80\xAF"
        "234 567\n",
        "400;1\xE2\x80\x99"
        "002.5\n500;999.25\n600;1234567\n"})
    EXPECT_EQ(only_of(text), lamp) << text;
  EXPECT_EQ(table_error("400;999,25\n500;1.002\n600;3,5\n"),
            "t.csv:2:5: error: \"1.002\" is not a number: its decimal sign or what parts its "
            "thousands can't be told");
  EXPECT_EQ(table_error("400;1 0025\n500;2\n600;3\n500;4\n").substr(0, 36),
            "t.csv:1:5: error: \"1 0025\" is not a ");
}

TEST(Table, WithCommasOfTwoKindsIsRefused) {
  const std::string commas = "commas part both cells and the digits of numbers";
  for (const char* text : {"400,0,1002\n500,0,2\n600,0,45\n",  // 0.1002 as no other column could be
                           "nm,R\n400,10,5\n500,20,25\n600,30,1\n",  // two headings, three cells
                           "nm,a,b\n400,1,5,2,5\n500,2,25,3,1\n",    // three and five
                           "400,1,05\n500,2,5\n600,3,5\n",           // no number begins with 05
                           "400,1,002.5\n500,1,500.2\n600,2,000.1\n"}) {  // thousands
    EXPECT_NE(table_error(text).find(commas), std::string::npos) << text << table_error(text);
  }
  // Whole numbers may be columns of their own, which is said.
  const SpectrumFile counts = table("400,12,305\n500,20,410\n600,7,99\n");
  EXPECT_EQ(counts.spectra.size(), 2U);
  ASSERT_EQ(counts.notes.size(), 1U);
  EXPECT_EQ(counts.notes[0],
            "read as 2 columns of whole numbers; with decimal commas it would be 1, parted by "
            "semicolons or tabs");
  for (const char* silent : {"nm,a,b\n400,12,305\n500,20,410\n", "400;12;305\n500;20;410\n",
                             "400,0.1,3\n500,0.2,4\n", "400,12\n500,20\n"})
    EXPECT_TRUE(table(silent).notes.empty()) << silent;
}

TEST(Table, CountsBlankCells) {
  const SpectrumFile file = table("nm,a,b,c\n400,1.5,,3\n410,,,3\n420,2,0.5,3\n");
  ASSERT_EQ(file.spectra.size(), 3U);
  EXPECT_EQ(file.spectra[0].blank, 1U);
  EXPECT_EQ(file.spectra[1].blank, 2U);
  EXPECT_EQ(file.spectra[2].blank, 0U);
  const SpectrumFile wide = table("Name,400,410,420\na,1,,3\nb,1,2,3\n");
  EXPECT_EQ(wide.spectra.at(0).blank, 1U);
  EXPECT_EQ(wide.spectra.at(1).blank, 0U);
  const auto taken = interpret(file, file.spectra[1], {}, Use::any);
  ASSERT_TRUE(taken);
  EXPECT_EQ(taken->notes.front(), "2 cells are blank: there are no samples at these wavelengths");
}

TEST(Table, TakesDecimalCommasInQuotes) {
  EXPECT_EQ(only_of("380,\"0,25\"\n390,\"0,5\"\n400,\"0,125\"\n"), fabric);
}

TEST(Table, ColumnsKeepTheNamesThatHeadingsGiveThem) {
  const auto names = [](const std::string& heading) {
    std::string all;
    for (const NamedSpectrum& one : table(heading + "380;0,1;0,2\n390;0,3;0,4\n").spectra)
      all += one.name + "|";
    return all;
  };
  EXPECT_EQ(names("nm;A %;B %\n"), "A %|B %|");
  EXPECT_EQ(names("nm;A [%];B (%)\n"), "A|B|");
  EXPECT_EQ(names("nm;1;2\n"), "1|2|");
  EXPECT_EQ(names("nm;red;blue\nnm;1;1\n"), "red|blue|") << "a line of units";
  EXPECT_EQ(names("nm;red;blue\nnm;[%];%\n"), "red|blue|");
  EXPECT_EQ(names("nm;R(λ) a;R(λ) b\n"), "R(λ) a|R(λ) b|");
}

TEST(Table, WithPercentsInSomeColumnsScalesWhatCanBeRelativeToOneAlone) {
  const SpectrumFile all = table("nm;A [%];B\n380;10;20\n390;30;40\n400;50;60\n");
  EXPECT_EQ(all.spectra[1].spectrum.values, (std::vector<double>{20, 40, 60}));
  EXPECT_EQ(all.notes.back(), "column 3 is taken for percents, as others say that they are");
  const SpectrumFile one = table("nm;A [%];B\n380;10;0,2\n390;30;0,4\n400;50;0,6\n");
  EXPECT_EQ(one.spectra[1].spectrum.values, (std::vector<double>{20, 40, 60}));
  EXPECT_TRUE(one.notes.empty());
}

TEST(Table, TheWavelengthsStandFirst) {
  EXPECT_EQ(table_error("R,nm\n0.5,400\n0.6,500\n"),
            "t.csv:1:3: error: the column of the wavelengths has to stand before those of values");
  EXPECT_EQ(only_of("nm;R(λ)\n400;0,5\n500;0,7\n").values, (std::vector<double>{0.5, 0.7}));
}

TEST(Table, OfOceanViewSaysWhatItsValuesAre) {
  const auto text = [](const std::string& mode) {
    return "Data from x\nXAxis mode: Wavelengths\nYAxis mode: " + mode +
           "\n>>>>>Begin Spectral Data<<<<<\n400\t0.5\n500\t0.6\n";
  };
  EXPECT_EQ(table_error(text("Absorbance")),
            "t.csv:3:1: error: absorbance is neither a reflectance, a transmittance nor a power");
  EXPECT_EQ(table_error(text("Reflection")), "no error");
}

}  // namespace
}  // namespace metamer
