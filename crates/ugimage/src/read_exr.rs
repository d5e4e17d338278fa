//! Reads OpenEXR files: the first part with colours, or else with grey, with its windows and
//! chromaticities.

use std::io::Cursor;

use exr::compression::Compression;
use exr::math::Vec2;
use exr::meta::attribute::ChannelDescription;
use exr::meta::header::Header;
use exr::prelude::{
    ReadChannels, ReadLayers, ReadSpecificChannel, pixel_vec::PixelVec, read as exr_reader,
};

use crate::encoding::Encoding;
use crate::read::{
    Declared, MOST_INFLATED, PictureLimits, ReadError, check_packed, reserved, unreadable,
};

/// Bytes of a pixel of light.
const N_BYTES_OF_LIGHT: u64 = size_of::<[f32; 4]>() as u64;

/// The size of the display window, and the light in it: black outside of the data window.
///
/// # Errors
/// [`ReadError`] if the file is truncated or corrupt, has no colours, or exceeds a limit.
pub(crate) fn read(
    file: &[u8],
    limits: &PictureLimits,
    declared: &mut Declared,
    notes: &mut Vec<String>,
) -> Result<([u32; 2], Vec<[f32; 4]>), ReadError> {
    let broken = |error: &dyn std::fmt::Display| unreadable("EXR", error);
    let Part { header, channels, size, notes: told } = part(file, limits)?;
    notes.extend(told);
    let (data_size, mut pixels) = channels.read(file).map_err(|error| broken(&error))?;
    // Colours of EXR files are multiplied by alpha.
    for [red, green, blue, alpha] in &mut pixels {
        if *alpha > 0.0 && *alpha < 1.0 {
            [*red, *green, *blue] = [*red / *alpha, *green / *alpha, *blue / *alpha];
        }
    }
    let attributes = &header.shared_attributes;
    declared.encoding = attributes.chromaticities.and_then(|chromaticities| {
        let pair = |Vec2(x, y): Vec2<f32>| [x, y].map(f64::from);
        let exr::meta::attribute::Chromaticities { red, green, blue, white } = chromaticities;
        Encoding::from_chromaticities([red, green, blue, white].map(pair), None)
    });
    let display = attributes.display_window;
    let Vec2(x, y) = header.own_attributes.layer_position;
    let corner = [x, y].map(i64::from);
    let origin = [display.position.x(), display.position.y()].map(i64::from);
    if data_size == size && corner == origin {
        return Ok((size, pixels));
    }
    let mut shown = reserved(size[0] as usize * size[1] as usize)?;
    for row in 0..i64::from(size[1]) {
        let row = row + origin[1] - corner[1];
        for column in 0..i64::from(size[0]) {
            let column = column + origin[0] - corner[0];
            let is_in = (0..i64::from(data_size[0])).contains(&column)
                && (0..i64::from(data_size[1])).contains(&row);
            let idx = if is_in { row * i64::from(data_size[0]) + column } else { -1 };
            shown.push(
                usize::try_from(idx)
                    .ok()
                    .and_then(|idx| pixels.get(idx))
                    .copied()
                    .unwrap_or_default(),
            );
        }
    }
    Ok((size, shown))
}

/// The size of the display window of a file by its headers; the pixels are not unpacked.
///
/// # Errors
/// As [`read`], except for corrupt pixels.
pub(crate) fn check(file: &[u8], limits: &PictureLimits) -> Result<[u32; 2], ReadError> {
    Ok(part(file, limits)?.size)
}

/// The part of a file that is read.
struct Part {
    header: Header,
    channels: Channels,
    /// Of the display window.
    size: [u32; 2],
    /// What is left out.
    notes: Vec<String>,
}

fn part(file: &[u8], limits: &PictureLimits) -> Result<Part, ReadError> {
    /// Of headers, as the decoder of pixels checks them.
    const PEDANTIC: bool = true;
    let broken = |error: &dyn std::fmt::Display| unreadable("EXR", error);
    let headers = exr::meta::MetaData::read_from_buffered(Cursor::new(file), PEDANTIC);
    let headers = headers.map_err(|error| broken(&error))?.headers;
    // The first layer with these channels is read, so none may be too large.
    for header in headers.iter().filter(|header| !header.deep) {
        check_layer(header, file.len(), limits)?;
    }
    let flat = || headers.iter().filter(|header| !header.deep);
    let colored = flat().find_map(|header| Some((header, Channels::colors_of(header)?)));
    let Some((header, channels)) =
        colored.or_else(|| flat().find_map(|header| Some((header, Channels::grey_of(header)?))))
    else {
        return Err(unreadable("EXR", &no_colors(&headers)));
    };
    let mut notes = Vec::from_iter(channels.note.clone());
    notes.extend(other_pictures(&headers, header, &channels));
    let display = header.shared_attributes.display_window;
    let size = limits.check([display.size.width(), display.size.height()], N_BYTES_OF_LIGHT)?;
    Ok(Part { header: header.clone(), channels, size, notes })
}

/// A picture of radiances at wavelengths.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SpectralPicture {
    /// Width and height.
    pub size: [u32; 2],
    /// Wavelengths in nm, rising, each with the radiance of every pixel, row after row from the
    /// top.
    pub samples: Vec<(f64, Vec<f32>)>,
}

/// The wavelength in the name of a channel of unpolarised light, such as `S0.450nm` or
/// `S0.450,5nm` (Fichet et al. 2021).
fn wavelength_nm(name: &str) -> Option<f64> {
    let digits = name.strip_prefix("S0.")?.strip_suffix("nm")?;
    digits.replace(',', ".").parse().ok().filter(|nm: &f64| *nm > 0.0 && nm.is_finite())
}

/// Reads the channels of an EXR file that are named by wavelengths; without samples if it has fewer
/// than four, or is another file. Of a file with several layers the first counts, and the data
/// window must be that of the display.
///
/// # Errors
/// [`ReadError`] if the file is truncated or corrupt, or exceeds a limit.
pub fn read_spectrum(file: &[u8], limits: &PictureLimits) -> Result<SpectralPicture, ReadError> {
    const MAGIC: [u8; 4] = [0x76, 0x2f, 0x31, 0x01];
    const LEAST: usize = 4;
    let broken = |error: &dyn std::fmt::Display| unreadable("EXR", error);
    if !file.starts_with(&MAGIC) {
        return Ok(SpectralPicture::default());
    }
    let headers = exr::meta::MetaData::read_from_buffered(Cursor::new(file), true);
    let headers = headers.map_err(|error| broken(&error))?.headers;
    let names = |header: &Header| {
        header
            .channels
            .list
            .iter()
            .filter(|it| wavelength_nm(&it.name.to_string()).is_some())
            .count()
    };
    let Some(header) = headers.first().filter(|header| !header.deep && names(header) >= LEAST)
    else {
        return Ok(SpectralPicture::default());
    };
    check_layer(header, file.len(), limits)?;
    let [width, height] = [header.layer_size.width(), header.layer_size.height()];
    let n_bytes = (size_of::<f32>() * header.channels.list.len()) as u64;
    let size = limits.check([width, height], n_bytes)?;
    let display = header.shared_attributes.display_window;
    if display.size != header.layer_size || display.position != header.own_attributes.layer_position
    {
        return Err(broken(&"a picture of wavelengths shows a part of its window"));
    }
    drop(reserved::<u8>(n_bytes as usize * width * height)?);
    let image = exr_reader()
        .no_deep_data()
        .largest_resolution_level()
        .all_channels()
        .first_valid_layer()
        .all_attributes()
        .non_parallel()
        .from_buffered(Cursor::new(file))
        .map_err(|error| broken(&error))?;
    let channels = image.layer_data.channel_data.list.into_iter();
    let mut samples: Vec<(f64, Vec<f32>)> = channels
        .filter_map(|channel| {
            let nm = wavelength_nm(&channel.name.to_string())?;
            let values: Vec<f32> = channel.sample_data.values_as_f32().collect();
            (values.len() == width * height).then_some((nm, values))
        })
        .collect();
    samples.sort_by(|a, b| a.0.total_cmp(&b.0));
    samples.dedup_by(|a, b| a.0 == b.0);
    Ok(SpectralPicture { size, samples })
}

fn names(header: &Header) -> Vec<String> {
    header.channels.list.iter().map(|channel| channel.name.to_string()).collect()
}

/// The channels of a layer that are read.
struct Channels {
    /// Red, green and blue; of a grey picture its channel and two names that differ from it.
    names: [String; 3],
    is_grey: bool,
    alpha: String,
    note: Option<String>,
}

/// Beginnings of the names of channels with colours: those that end with these letters.
fn prefixes<'n>(names: &'n [String], letters: [&str; 3]) -> Vec<&'n str> {
    let has = |prefix: &str, letter: &str| {
        names.iter().any(|known| known.strip_suffix(letter) == Some(prefix))
    };
    let all = names.iter().filter_map(|name| name.strip_suffix(letters[0]));
    all.filter(|prefix| letters.iter().all(|letter| has(prefix, letter))).collect()
}

/// Why no part of a file is read, with the names of its channels.
fn no_colors(headers: &[Header]) -> String {
    /// The most names.
    const MOST: usize = 12;
    if headers.iter().all(|header| header.deep) {
        return "it has deep pixels; flatten them".to_owned();
    }
    let names: Vec<String> = headers.iter().flat_map(names).collect();
    let more = if names.len() > MOST { ", …" } else { "" };
    let shown: Vec<String> = names.iter().take(MOST).map(|name| format!("`{name}`")).collect();
    format!(
        "it has no channels of colours (`R`, `G`, `B`, or `Y`): its channels are {}{more}",
        shown.join(", ")
    )
}

/// The note on pictures of a file that are not read, such as the one for the other eye. `read`: the
/// part that is read.
fn other_pictures(headers: &[Header], read: &Header, channels: &Channels) -> Option<String> {
    let text = |text: &Option<exr::meta::attribute::Text>| text.as_ref().map(ToString::to_string);
    let name_of = |header: &Header| {
        let attributes = &header.own_attributes;
        text(&attributes.view_name).or_else(|| text(&attributes.layer_name)).unwrap_or_default()
    };
    let is_picture = |header: &&Header| !header.deep && !prefixes(&names(header), RGB).is_empty();
    let others: Vec<&Header> =
        headers.iter().filter(|header| !std::ptr::eq(*header, read)).filter(is_picture).collect();
    let quoted = |names: Vec<String>| {
        names.iter().map(|name| format!("`{name}`")).collect::<Vec<_>>().join(", ")
    };
    if !others.is_empty() {
        let names = others.into_iter().map(name_of).collect();
        let read = name_of(read);
        return Some(format!("of the parts of the file `{read}` is read, not {}", quoted(names)));
    }
    // Several views in one part: that of the other eye has its name before its channels.
    let names = names(read);
    let is_view = |prefix: &str| {
        let mut words = prefix.split('.');
        words.any(|word| word.eq_ignore_ascii_case("left") || word.eq_ignore_ascii_case("right"))
    };
    let mine = channels.names[0].strip_suffix('R');
    let views = prefixes(&names, RGB).into_iter().filter(|prefix| is_view(prefix));
    let views: Vec<String> = views
        .filter(|prefix| Some(*prefix) != mine)
        .map(|prefix| prefix.trim_end_matches('.').to_owned())
        .collect();
    (!views.is_empty())
        .then(|| format!("the picture for another eye is not read: {}", quoted(views)))
}

/// The last letters of channels with colours.
const RGB: [&str; 3] = ["R", "G", "B"];

impl Channels {
    /// `R`, `G` and `B`; or those of a layer in the names, as Blender writes them; or `r`, `g` and
    /// `b`, as a few programs do.
    fn colors_of(header: &Header) -> Option<Self> {
        Self::colors_with(&names(header), RGB, "A")
            .or_else(|| Self::colors_with(&names(header), ["r", "g", "b"], "a"))
    }

    fn colors_with(names: &[String], letters: [&str; 3], alpha: &str) -> Option<Self> {
        let mut prefixes = prefixes(names, letters);
        // The combined picture before its parts.
        prefixes
            .sort_by_key(|prefix| (!prefix.is_empty(), !prefix.contains("Combined"), prefix.len()));
        let prefix = prefixes.first()?;
        let colors = |prefix: &str| letters.map(|letter| format!("{prefix}{letter}"));
        let names = colors(prefix);
        let [red, green, blue] = &names;
        let note = (!prefix.is_empty()).then(|| {
            format!("of the channels of the picture `{red}`, `{green}` and `{blue}` are read")
        });
        let alpha = format!("{prefix}{alpha}");
        Some(Self { names, is_grey: false, alpha, note })
    }

    /// Luminance, or the only channel.
    fn grey_of(header: &Header) -> Option<Self> {
        let names = names(header);
        let has = |name: &str| names.iter().any(|known| known == name);
        let alone = if names.len() == 1 { names.first().map(String::as_str) } else { None };
        let grey = if has("Y") { "Y" } else { alone? };
        let note = if has("RY") {
            "of the picture only its luminance is read; write red, green and blue".to_owned()
        } else {
            format!("the picture has no colours: its channel `{grey}` is read as grey")
        };
        // The decoder refuses to look for one name twice.
        let names = ["", "+1", "+2"].map(|end| format!("{grey}{end}"));
        let alpha = if grey == "A" { "no alpha" } else { "A" };
        Some(Self { names, is_grey: true, alpha: alpha.to_owned(), note: Some(note) })
    }

    fn read(&self, file: &[u8]) -> exr::error::Result<([u32; 2], Vec<[f32; 4]>)> {
        let [red, green, blue] = [0, 1, 2].map(|idx| self.names[idx].as_str());
        let is_grey = self.is_grey;
        let image = exr_reader()
            .no_deep_data()
            .largest_resolution_level()
            .specific_channels()
            .required(red)
            .optional(green, 0.0_f32)
            .optional(blue, 0.0_f32)
            .optional(self.alpha.as_str(), 1.0_f32)
            .collect_pixels(
                |resolution, _| PixelVec {
                    resolution,
                    pixels: vec![[0.0_f32; 4]; resolution.area()],
                },
                move |image, position, (red, green, blue, alpha): (f32, f32, f32, f32)| {
                    let idx = position.flat_index_for_size(image.resolution);
                    let [green, blue] = if is_grey { [red; 2] } else { [green, blue] };
                    image.pixels[idx] = [red, green, blue, alpha];
                },
            )
            .first_valid_layer()
            .all_attributes()
            .non_parallel()
            .from_buffered(Cursor::new(file))?;
        let data = image.layer_data.channel_data.pixels;
        Ok(([data.resolution.width() as u32, data.resolution.height() as u32], data.pixels))
    }
}

/// Refuses a layer whose pixels exceed the limits, or need more bytes than the `n_file` of the file
/// can hold.
fn check_layer(header: &Header, n_file: usize, limits: &PictureLimits) -> Result<(), ReadError> {
    /// Bytes in the file for each block of pixels: its place, its row, its size.
    const N_BYTES_OF_BLOCK: u64 = 16;
    let size =
        limits.check([header.layer_size.width(), header.layer_size.height()], N_BYTES_OF_LIGHT)?;
    let n_pixels = size[0] as usize * size[1] as usize;
    let n_bytes = |channel: &ChannelDescription| {
        // A channel may have one sample for several pixels. The decoder refuses one for none.
        let n_along = |side: u32, sampling: usize| u64::from(side) / (sampling as u64).max(1);
        let n_samples =
            n_along(size[0], channel.sampling.x()) * n_along(size[1], channel.sampling.y());
        channel.sample_type.bytes_per_sample() as u64 * n_samples
    };
    let n_stored = header.channels.list.iter().map(n_bytes).fold(0, u64::saturating_add);
    let ratio = match header.compression {
        Compression::Uncompressed => 1,
        // Runs of 128 bytes have two.
        Compression::RLE => 64,
        // Some store 3 of 4 bytes first.
        _ => MOST_INFLATED * 4 / 3,
    };
    check_packed(n_file, n_stored, ratio)?;
    check_packed(n_file, N_BYTES_OF_BLOCK * header.chunk_count as u64, 1)?;
    // Reserved before the decoder allocates as much; it is used only for pixels that are read.
    drop(reserved::<[f32; 4]>(n_pixels)?);
    Ok(())
}
