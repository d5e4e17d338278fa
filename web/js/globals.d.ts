// The JavaScript of wasm-bindgen, around the programs.
declare const wasm_bindgen: any;
