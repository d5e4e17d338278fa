//! Hostile vector figures, SVG and PDF, the input of `ugsheet`.

use std::sync::LazyLock;

use ugimage::Format;
use ugtesting::Random;

use super::line::{flags, maybe, numbers, word, words as line_of};
use super::{Files, bytes, picture, words};

/// Figures, mostly of one format, and the command line that joins them.
pub fn sheet(random: &mut Random) -> (Files, Vec<String>) {
    let kind = *random.pick(&[Format::Svg, Format::Pdf]);
    let is_wild = random.one_in(2);
    let n = 1 + random.below(3);
    let file = |idx: usize, random: &mut Random| {
        let bytes = match usual(is_wild, 25, random) {
            0 => picture::png(random),
            1 => of(if kind == Format::Svg { Format::Pdf } else { Format::Svg }, random),
            _ => drawn(kind, is_wild, random),
        };
        (format!("{idx}.{}", kind.name()), bytes)
    };
    let files: Files = (0..n).map(|idx| file(idx, random)).collect();
    let mut line = line_of("ugsheet", &[]);
    line.extend(files.iter().map(|(name, _)| name.clone()));
    // Some are joined to themselves.
    if random.one_in(8) {
        line.push(files[0].0.clone());
    }
    let columns = word(random, &["1", "2", "4294967295"]);
    maybe(random, 4, &mut line, "-cols", columns);
    for option in ["-title", "-cap"] {
        let text = vec![words::name(random)];
        maybe(random, 4, &mut line, option, text);
    }
    let gap = if random.one_in(2) { numbers::<1>(random) } else { word(random, &["0", "3", "10000"]) };
    maybe(random, 6, &mut line, "-gap", gap);
    let labels = word(random, &["auto", "names", "none"]);
    maybe(random, 6, &mut line, "-lb", labels);
    let size = word(random, &["4", "11.5", "1000"]);
    maybe(random, 8, &mut line, "-ts", size);
    let format = word(random, &["svg", "pdf", "png", "ps"]);
    maybe(random, 20, &mut line, "-dt", format);
    flags(random, 3, &mut line, &["-txt", "-lt"]);
    flags(random, 30, &mut line, &["--history", "--tiles"]);
    (files, line)
}

/// A figure, half of them valid.
pub fn of(format: Format, random: &mut Random) -> Vec<u8> {
    let is_wild = random.one_in(2);
    drawn(format, is_wild, random)
}

fn drawn(format: Format, is_wild: bool, random: &mut Random) -> Vec<u8> {
    let mut bytes = if format == Format::Svg { svg(is_wild, random) } else { pdf(is_wild, random) };
    if is_wild && random.one_in(4) {
        bytes::damage(random, &mut bytes);
    }
    bytes
}

/// An SVG file; a wild one is malformed or very large in part.
fn svg(is_wild: bool, random: &mut Random) -> Vec<u8> {
    const HEADS: [&str; 7] = [
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n",
        "<!DOCTYPE svg PUBLIC \"-//W3C//DTD SVG 1.1//EN\" \"http://a\">",
        "\u{feff}",
        "<!-- a -- b -->",
        "<?xml version=\"1.0\" encoding=\"UTF-16\"?>",
        "<!DOCTYPE svg [<!ENTITY a \"aaaaaaaaaa\"><!ENTITY b \"&a;&a;&a;&a;\"><!ENTITY c \"&b;&b;&b;\">]>",
        "<!DOCTYPE svg SYSTEM \"file:///etc/passwd\">",
    ];
    let head = if is_wild && random.one_in(2) { *random.pick(&HEADS) } else { "" };
    let side = |random: &mut Random| match usual(is_wild, 8, random) {
        0 => words::number(random),
        1 => (*random
            .pick(&["100%", "1e8", "1e9", "-5", "1e308px", "nan", "inf", "5e-324", "", "1em", "9e99in"]))
        .to_owned(),
        _ => format!("{}{}", 1 + random.below(90), random.pick(&["", "px", "pt", "mm", " "])),
    };
    let [width, height] = [side(random), side(random)];
    let root = match usual(is_wild, 8, random) {
        0 => format!("width=\"{width}\""),
        1 => format!("viewBox=\"0 0 {width} {height}\""),
        2 => {
            let view =
                *random.pick(&["1 2 3", "0 0 1e308 1e308", "nan nan nan nan", "0,0,9\t9", "0 0 1e9 1e9"]);
            format!("viewBox=\"{view}\"")
        }
        _ => format!("width='{width}' height=\"{height}\""),
    };
    let space = "xmlns=\"http://www.w3.org/2000/svg\" xmlns:xlink=\"http://www.w3.org/1999/xlink\"";
    let mut text = format!("{head}<svg {space} {root}>");
    for _ in 0..random.below(6) {
        text += &element(is_wild, random);
    }
    (text + if is_wild && random.one_in(20) { "" } else { "</svg>" }).into_bytes()
}

fn element(is_wild: bool, random: &mut Random) -> String {
    const HOSTILE: [&str; 30] = [
        "<g id=\"&a;\"/>",
        "<g id=\"a & b\"/>",
        "<g id=\"<\"/>",
        "<g id=\"&#0;\"/>",
        "&#0;",
        "&#xFFFFFFFFF;",
        "&#x1b;",
        "&#xd800;",
        "&b;",
        "]]>",
        "\u{fffe}\u{ffff}",
        "<g a=1/>",
        "<g a a='1'/>",
        "<g a='1' a='2'/>",
        "<1/>",
        "<a\"b/>",
        "<g a\"b='1'/>",
        "<g a,b='1'/>",
        "<x:y/>",
        "<xlink:y x:z='1'/>",
        "<style>*{fill:red}</style>",
        "<style>@import 'a';</style><script>alert(1)</script>",
        "<g onload='f()'/>",
        "<image href='file:///etc/passwd'/>",
        "<use href='#a' fill='url(#'/><use href='#' fill='url( '/>",
        "<?xml-stylesheet href='a'?>",
        "<!-- -- ---><![CDATA[<svg>]]]]>",
        "<![CDATA[",
        "<svg width='9' height='9'><svg/></svg></g>",
        "<g fill='url(\"#a\") url(&quot;#b&quot;) url(#c'/>",
    ];
    match usual(is_wild, 20, random) {
        0 => "<g>".repeat(1 + random.below(100_000)),
        1 => {
            let n = 1 + random.below(20_000);
            format!("{}{}", "<g>".repeat(n), "</g>".repeat(n))
        }
        2 => {
            let n = *random.pick(&[3, 300, 100_000]);
            let attributes: String = (0..n).map(|idx| format!(" a{idx}=''")).collect();
            format!("<g{attributes}/>")
        }
        3 => format!("<g fill='{}'/>", "url(#".repeat(random.below(200_000))),
        4 => format!("<g a='{}'/>", "x".repeat(random.below(2_000_000))),
        5 => format!("<{}/>", "x".repeat(random.below(2_000_000))),
        6..=10 => (*random.pick(&HOSTILE)).to_owned(),
        11 => format!("<text id='{0}'>{0}</text>", words::name(random)),
        _ => {
            let color = *random.pick(&["red", "url(#a)", "#123", "none"]);
            let id = random.below(3);
            format!("<g id='a{id}'><path d='M0 0L{} 9z' fill='{color}'/></g>", words::number(random))
        }
    }
}

/// A PDF file of one page; a wild one is malformed in part, or its table lies.
fn pdf(is_wild: bool, random: &mut Random) -> Vec<u8> {
    let content = b"0 0 1 rg 0 0 9 9 re f /A Do".to_vec();
    let length = match usual(is_wild, 12, random) {
        0 => (*random.pick(&["0", "9999999999", "-1", "4 0 R", "6 0 R", "1e3", "99 0 R", "(a)", "0.5"]))
            .to_owned(),
        1 => "7 0 R".to_owned(),
        _ => content.len().to_string(),
    };
    let bounds = match usual(is_wild, 6, random) {
        0 => (*random.pick(&[
            "[0 0 1e308 1e308]",
            "[0 0 99999999999999999999 99999999999999999999]",
            "[-900000000 0 99 9]",
            "[0 0 1000000000 1000000000]",
            "[9 9 9 9]",
            "[90 90 0 0]",
            "[0 0 8 0 R 8 0 R]",
            "[.000000000000000000000000000000000001 0 9 9]",
            "8 0 R",
            "[0 0 NaN 9]",
            "[0 0 9]",
            "null",
        ]))
        .to_owned(),
        _ => format!("[0 0 {} {}]", 1 + random.below(90), 1 + random.below(90)),
    };
    let extra = if is_wild && random.one_in(2) { hostile(random) } else { "0".to_owned() };
    let kids = match usual(is_wild, 14, random) {
        0 => *random.pick(&[
            "2 0 R",
            "1 0 R",
            "3 0 R 3 0 R",
            "",
            "9 0 R",
            "<</Kids[<</Kids[3 0 R]>>]>>",
            "4 0 R",
        ]),
        _ => "3 0 R",
    };
    let of_page = match usual(is_wild, 12, random) {
        0 => *random.pick(&[
            "/Rotate 90",
            "/Rotate 360",
            "/UserUnit 1e9",
            "/UserUnit .0000001",
            "/UserUnit -1",
        ]),
        1 => *random.pick(&[
            "/Group 3 0 R",
            "/Group<</S/Transparency>>",
            "/UserUnit 8 0 R",
            "/CropBox[1 1 2 2]",
        ]),
        _ => "",
    };
    let filter = match usual(is_wild, 10, random) {
        0 => "/Filter/FlateDecode",
        1 => "/Filter[/ASCIIHexDecode/FlateDecode/FlateDecode]/DecodeParms[null 5 0 R null]",
        2 => "/F(file)/FFilter/FlateDecode/Type/ObjStm/N 999999999/First 0",
        _ => "",
    };
    let mut stream = format!("<</Length {length}{filter}>>stream\n").into_bytes();
    stream.extend(if is_wild && random.one_in(8) { bomb() } else { content });
    stream.extend(b"\nendstream");
    let mut objects = vec![
        b"<</Type/Catalog/Pages 2 0 R>>".to_vec(),
        format!(
            "<</Type/Pages/Count 1/Kids[{kids}]/X {}>>",
            if is_wild && random.one_in(9) { &extra } else { "0" }
        )
        .into_bytes(),
        format!(
            "<</Type/Page/Parent 2 0 R/MediaBox {bounds}/Contents 4 0 R{of_page}\
             /Resources<</ExtGState 5 0 R/XObject<</A 6 0 R>>>>>>"
        )
        .into_bytes(),
        stream,
        format!("<</A {extra}/B 5 0 R/C 3 0 R/#00#ff(\\377\\0\\n) 5>>").replace(") 5", ")").into_bytes(),
        b"<</Type/XObject/Subtype/Form/BBox[0 0 9 9]/Length 1/Resources 5 0 R>>stream\n \nendstream".to_vec(),
        b"27".to_vec(),
        (*random.pick(&["9", "8 0 R", "10 0 R", "1.7976931348623157", "(a)"])).as_bytes().to_vec(),
    ];
    if is_wild && random.one_in(6) {
        objects.extend(nested(random, objects.len() + 1));
    }
    assembled(is_wild, random, &objects)
}

/// An object that is deep, long or odd.
fn hostile(random: &mut Random) -> String {
    let n = *random.pick(&[3, 63, 64, 65, 1000, 100_000]);
    let repeated = |head: &str, tail: &str| head.repeat(n) + &tail.repeat(n);
    match random.below(16) {
        0 => repeated("[", "]"),
        1 => repeated("<</A", " 0>>"),
        2 => repeated("(", ")"),
        3 => format!("[{}]", "()".repeat(n)),
        4 => format!("[{}]", "0 ".repeat(10 * n)),
        5 => format!("<<{}>>", "/ 1".repeat(n)),
        6 => format!("[{}]", "9 0 R ".repeat(n)),
        7 => format!("[{}]", (0..n).map(|idx| format!("{idx} 0 R ")).collect::<String>()),
        8 => "9".repeat(n),
        9 => format!("-.{}1", "0".repeat(n)),
        10 => format!("<{}>", "4 ".repeat(n)),
        11 => "(\\".to_owned() + &"\\9".repeat(n),
        12 => format!("%{}\n1", "a".repeat(n)),
        13 => format!("/{}", "#00\u{fe}".repeat(n)),
        14 => (*random.pick(&["--1", "+", ".", "1e308", "nan", "inf", "1.2.3", "2147483648", "-2147483649"]))
            .to_owned(),
        _ => words::number(random),
    }
}

/// Objects that lie within each other, so that each seems to be as long as all that follow.
fn nested(random: &mut Random, first: usize) -> Vec<Vec<u8>> {
    let n = *random.pick(&[3, 300, 3000]);
    let mut inner = b"0".to_vec();
    for number in (first + 1..first + n).rev() {
        let head = format!("({number} 0 obj ");
        inner = [head.as_bytes(), &inner, b")"].concat();
    }
    vec![inner]
}

/// A stream of zeros that grows a thousandfold.
fn bomb() -> Vec<u8> {
    static DATA: LazyLock<Vec<u8>> = LazyLock::new(zeros);
    DATA.clone()
}

fn zeros() -> Vec<u8> {
    let frame = ugimage::Frame::new([4000, 1000], true, vec![[0; 4]; 4_000_000]);
    let file = Format::Png.encode(&frame, &ugimage::Metadata::default());
    let at = file.windows(4).position(|window| window == b"IDAT").map_or(0, |at| at + 4);
    file[at..].to_vec()
}

/// One of N choices: the last, which is usual, unless the file is wild.
fn usual(is_wild: bool, n: usize, random: &mut Random) -> usize {
    if is_wild { random.below(n) } else { n - 1 }
}

/// The file with its table of objects.
fn assembled(is_wild: bool, random: &mut Random, objects: &[Vec<u8>]) -> Vec<u8> {
    let mut file = b"%PDF-1.4\n%\xff\xff\n".to_vec();
    let mut places = Vec::new();
    for (idx, object) in objects.iter().enumerate() {
        places.push(file.len());
        file.extend(format!("{} 0 obj", idx + 1).as_bytes());
        file.extend([b"\n", object.as_slice(), b"\nendobj\n"].concat());
    }
    // Those within others, each in the one before.
    let mut at = 0;
    for number in objects.len() + 1.. {
        let head = format!("({number} 0 obj ");
        let found = file[at..].windows(head.len()).position(|window| window == head.as_bytes());
        let Some(step) = found else { break };
        at += step + 1;
        places.push(at);
    }
    let table = file.len();
    let count = match usual(is_wild, 12, random) {
        0 => *random.pick(&[0, 3, 99, 4_294_967_295]),
        _ => places.len() as u64 + 1,
    };
    let first = if is_wild && random.one_in(20) { *random.pick(&[1, 4_294_967_290]) } else { 0_u64 };
    file.extend(format!("xref\n{first} {count}\n0000000000 65535 f \n").as_bytes());
    for place in &places {
        let place = if is_wild && random.one_in(40) { random.below(2 * table) } else { *place };
        file.extend(format!("{place:010} 00000 n \n").as_bytes());
    }
    if is_wild && random.one_in(20) {
        file.extend(format!("0 {0}\n", 50_000).as_bytes());
        file.extend(b"0000000000 00000 n \n".repeat(50_000));
    }
    let more = match usual(is_wild, 12, random) {
        0 => format!("/Prev {table}"),
        1 => format!("/Prev {}", random.pick(&["0", "-1", "99999999999999999999", "1.5", "5 0 R"])),
        2 => {
            (*random.pick(&["/Encrypt 5 0 R", "/XRefStm 9", "/Encrypt<</Filter/Standard>>", "/Encrypt null"]))
                .to_owned()
        }
        _ => String::new(),
    };
    let root = if is_wild && random.one_in(25) {
        *random.pick(&["9 0 R", "5 0 R", "null", "[]", "1"])
    } else {
        "1 0 R"
    };
    file.extend(format!("trailer\n<</Size {count}/Root {root}{more}>>\nstartxref\n").as_bytes());
    let table = if is_wild && random.one_in(25) { random.below(2 * table) } else { table };
    file.extend(format!("{table}\n%%EOF\n").as_bytes());
    file
}
