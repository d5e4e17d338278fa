//! PDF: one page with an embedded image, one pixel per point, or as many as its metadata state.

use miniz_oxide::deflate::compress_to_vec_zlib;
use pdf_writer::writers::Resources;
use pdf_writer::{Content, Filter, Finish, Name, Pdf, Rect, Ref, TextStr};

use crate::{Frame, Metadata};

/// DEFLATE compression level: the usual default, a compromise between time and size.
const LEVEL: u8 = 6;

/// Longest page side in points that PDF allows with the default user unit.
const MAX_SIDE: u32 = 14_400;

const CATALOG: Ref = Ref::new(1);
const PAGES: Ref = Ref::new(2);
const PAGE: Ref = Ref::new(3);
const CONTENT: Ref = Ref::new(4);
const INFO: Ref = Ref::new(5);
/// Number of the first object after these.
pub const FIRST: i32 = 6;

const IMAGE: Ref = Ref::new(FIRST);
const MASK: Ref = Ref::new(FIRST + 1);

/// The frame as a PDF file; transparency is kept as a soft mask.
pub fn encode(frame: &Frame, metadata: &Metadata) -> Vec<u8> {
    let size = [frame.width(), frame.height()];
    let mut pdf = Pdf::new();
    let colors: Vec<[u8; 3]> = frame.pixels().iter().map(|&[r, g, b, _]| [r, g, b]).collect();
    image(&mut pdf, IMAGE, size, Channels::Colors, colors.as_flattened(), !frame.is_opaque());
    if !frame.is_opaque() {
        let alphas: Vec<u8> = frame.pixels().iter().map(|pixel| pixel[3]).collect();
        image(&mut pdf, MASK, size, Channels::Grey, &alphas, false);
    }
    let size = metadata.points(size);
    let mut content = Content::new();
    content.transform([size[0] as f32, 0.0, 0.0, size[1] as f32, 0.0, 0.0]);
    content.x_object(Name(b"I"));
    let content = content.finish();
    document(pdf, size, metadata, content.as_slice(), |resources| {
        resources.x_objects().pair(Name(b"I"), IMAGE);
    })
}

/// The channels of an embedded image.
#[derive(Clone, Copy)]
enum Channels {
    Colors,
    Grey,
}

fn image(
    pdf: &mut Pdf,
    id: Ref,
    size: [u32; 2],
    channels: Channels,
    bytes: &[u8],
    is_masked: bool,
) {
    let data = deflate(bytes);
    let mut image = pdf.image_xobject(id, &data);
    image.filter(Filter::FlateDecode);
    // The casts do not overflow: a side is at most 2^24 pixels.
    image.width(size[0] as i32).height(size[1] as i32).bits_per_component(8);
    match channels {
        Channels::Colors => image.color_space().device_rgb(),
        Channels::Grey => image.color_space().device_gray(),
    }
    if is_masked {
        image.s_mask(MASK);
    }
}

/// Compresses bytes for the filter `FlateDecode`.
pub fn deflate(bytes: &[u8]) -> Vec<u8> {
    compress_to_vec_zlib(bytes, LEVEL)
}

/// Makes a file with one page of `size` points. `pdf` already contains the objects that `resources`
/// refers to. The metadata becomes the document information; there is no date and no id.
pub fn document(
    mut pdf: Pdf,
    size: [u32; 2],
    metadata: &Metadata,
    content: &[u8],
    resources: impl FnOnce(&mut Resources<'_>),
) -> Vec<u8> {
    let unit = size[0].max(size[1]).div_ceil(MAX_SIDE) as f32;
    let [width, height] = size.map(|side| side as f32 / unit);
    pdf.catalog(CATALOG).pages(PAGES);
    pdf.pages(PAGES).kids([PAGE]).count(1);
    let mut page = pdf.page(PAGE);
    page.media_box(Rect::new(0.0, 0.0, width, height)).parent(PAGES).contents(CONTENT);
    let mut drawing = Content::new();
    if unit > 1.0 {
        // The page keeps its size: its user unit is `unit` points.
        page.user_unit(unit);
        drawing.transform([1.0 / unit, 0.0, 0.0, 1.0 / unit, 0.0, 0.0]);
    }
    let mut drawing = drawing.finish().into_vec();
    drawing.push(b'\n');
    drawing.extend_from_slice(content);
    resources(&mut page.resources());
    page.finish();
    let data = deflate(&drawing);
    pdf.stream(CONTENT, &data).filter(Filter::FlateDecode);
    let mut info = pdf.document_info(INFO);
    if !metadata.software.is_empty() {
        info.creator(TextStr(&metadata.software)).producer(TextStr(&metadata.software));
    }
    if !metadata.comment.is_empty() {
        info.subject(TextStr(&metadata.comment));
    }
    info.finish();
    pdf.finish()
}
