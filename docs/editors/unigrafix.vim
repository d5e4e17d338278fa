" UniGrafix scenes for Vim. Copy this file to ~/.vim/syntax, and add to ~/.vimrc
"   autocmd BufRead,BufNewFile *.ug set filetype=unigrafix
"   autocmd FileType unigrafix set omnifunc=syntaxcomplete#Complete commentstring={%s}
" Written by the tests of ugparse from its table of statements.
if exists("b:current_syntax") | finish | endif
setlocal iskeyword=@,48-57,_,:,#,-
syn keyword ugKeyword contained v w label f sphere cylinder tube disc c c_rgb c_xyz c_bb c_spd c_refl c_mix c_time c_tex c_emit surf l cam motion sky def end i a include execute
syn keyword ugOption -M3 -M4 -acc -area -at -blend -cl -ep -factor -fl -fs -gamma -image -inner -ma -mask -mv -mx -my -mz -nearest -og -on -orbit -path -period -ph -ps -ra -rv -rx -ry -rz -sa -shift -spin -spot -step -sv -sx -sy -sz -ta -turn -tv -tx -ty -tz -ud -va -vc -vel -wrap
syn match ugStatement /\%(^\|[;}]\)\@1<=\s*\h\w*/ contains=ugKeyword
syn match ugNumber /[-+]\?\%(\d\+\.\?\d*\|\.\d\+\)\%([eE][-+]\?\d\+\)\?\>/
syn region ugString start=/"/ end=/"/ oneline
syn region ugComment start=/{/ end=/}/ contains=ugComment
hi def link ugKeyword Statement
hi def link ugOption Type
hi def link ugNumber Number
hi def link ugString String
hi def link ugComment Comment
let b:current_syntax = "unigrafix"
