//! What viewers of 360° pictures read of a panorama: Photo Sphere XMP metadata (`GPano`).

/// The part of a whole equirectangular panorama, 360° wide and 180° high, that a picture shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PanoramaArea {
    /// Width and height of the whole panorama in pixels, twice as wide as high.
    pub whole: [u32; 2],
    /// Left column and upper row of the picture in it.
    pub corner: [u32; 2],
}

impl PanoramaArea {
    /// The XMP packet for a picture of this size.
    pub(crate) fn xmp(self, size: [u32; 2]) -> String {
        let numbers = [
            (FULL[0], self.whole[0]),
            (FULL[1], self.whole[1]),
            ("CroppedAreaImageWidthPixels", size[0]),
            ("CroppedAreaImageHeightPixels", size[1]),
            (CORNER[0], self.corner[0]),
            (CORNER[1], self.corner[1]),
        ];
        let numbers = numbers.map(|(name, number)| format!("\n    GPano:{name}=\"{number}\""));
        format!(
            "<?xpacket begin=\"\u{feff}\" id=\"W5M0MpCehiHzreSzNTczkc9d\"?>\n\
             <x:xmpmeta xmlns:x=\"adobe:ns:meta/\">\n \
             <rdf:RDF xmlns:rdf=\"http://www.w3.org/1999/02/22-rdf-syntax-ns#\">\n  \
             <rdf:Description rdf:about=\"\"\n    \
             xmlns:GPano=\"http://ns.google.com/photos/1.0/panorama/\"\n    \
             GPano:UsePanoramaViewer=\"True\"\n    \
             GPano:ProjectionType=\"equirectangular\"{}/>\n \
             </rdf:RDF>\n\
             </x:xmpmeta>\n\
             <?xpacket end=\"r\"?>",
            numbers.concat()
        )
    }

    /// Reads it from an XMP packet that [`PanoramaArea::xmp`] has written.
    pub(crate) fn from_xmp(text: &str) -> Option<Self> {
        let number = |name: &str| {
            let (_, rest) = text.split_once(&format!("GPano:{name}=\""))?;
            rest.split_once('"')?.0.parse().ok()
        };
        let pair = |[across, down]: [&str; 2]| Some([number(across)?, number(down)?]);
        Some(Self { whole: pair(FULL)?, corner: pair(CORNER)? })
    }
}

/// The part of the whole that a picture of `size` shows by an XMP packet of any program: its left,
/// right, upper and lower edge, as fractions of the whole. `None` for the whole.
pub(crate) fn part_of_xmp(text: &str, size: [u32; 2]) -> Option<[f64; 4]> {
    let number = |name: &str| -> Option<f64> {
        // An attribute, or an element.
        let (_, rest) = text.split_once(&format!("GPano:{name}"))?;
        let rest = rest.trim_start_matches(['=', '"', '\'', '>', ' ']);
        let end = rest.find(|c: char| !c.is_ascii_digit() && c != '.').unwrap_or(rest.len());
        rest[..end].parse().ok()
    };
    let [width, height] = [number(FULL[0])?, number(FULL[1])?];
    let [left, top] = [number(CORNER[0])?, number(CORNER[1])?];
    let [across, down] = [
        number("CroppedAreaImageWidthPixels").unwrap_or(size[0].into()),
        number("CroppedAreaImageHeightPixels").unwrap_or(size[1].into()),
    ];
    let part = [left / width, (left + across) / width, top / height, (top + down) / height];
    let is_part =
        part.iter().all(|edge| (0.0..=1.0 + 1e-9).contains(edge)) && part != [0.0, 1.0, 0.0, 1.0];
    is_part.then_some(part)
}

/// Names of the width and height of the whole panorama.
const FULL: [&str; 2] = ["FullPanoWidthPixels", "FullPanoHeightPixels"];

/// Names of the place of the picture in it.
const CORNER: [&str; 2] = ["CroppedAreaLeftPixels", "CroppedAreaTopPixels"];
